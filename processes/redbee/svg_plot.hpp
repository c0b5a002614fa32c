// Small line and scatter plots as SVG text, for pages that stand alone.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace redbee {

class SvgPlot {
 public:
  SvgPlot(std::string title, std::string x_label, std::string y_label);

  /// NaN breaks a line. Colour: any of SVG's.
  void addLine(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
               const std::string& colour);
  void addPoints(const std::string& name, const std::vector<Eigen::Vector2d>& points,
                 const std::string& colour);
  /// A dashed vertical line at x.
  void addMark(const std::string& name, double x);
  /// Same unit on both axes, the origin in the middle, `reach` to all sides; points beyond are not drawn.
  void makeSquare(double reach);

  std::string svg() const;

 private:
  struct Series {
    std::string name;
    std::vector<Eigen::Vector2d> points;
    std::string colour;
    bool line;
  };
  struct Range {
    double low, high;
    double share(double value) const { return (value - low) / (high - low); }
  };
  Range rangeOf(int axis) const;

  std::string title_, x_label_, y_label_;
  std::vector<Series> series_;
  std::vector<std::pair<std::string, double>> marks_;
  double reach_ = 0;
};

}  // namespace redbee
