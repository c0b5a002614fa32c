// Line and scatter plots as SVG text, drawn by gnuplot.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

namespace redbee {

class SvgPlot {
 public:
  SvgPlot(std::string title, std::string x_label, std::string y_label);

  /// Values that are not finite interrupt the line. Colour: #rrggbb or a name known to gnuplot.
  void addLine(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
               const std::string& colour);
  void addPoints(const std::string& name, const std::vector<Eigen::Vector2d>& points,
                 const std::string& colour);
  /// A dashed vertical line at x.
  void addMark(const std::string& name, double x);
  /// Both axes from `low` to `high` in the same unit; points beyond are not drawn.
  void makeSquare(double low, double high);

  /// Throws std::runtime_error where gnuplot fails.
  std::string svg() const;

  /// Throws InputError with the fix where gnuplot is not installed. Called before long work, not after it.
  static void checkInstalled();

 private:
  struct Series {
    std::string name;
    std::vector<Eigen::Vector2d> points;
    std::string colour;
    bool line;
  };
  static bool isDrawable(const Series& series);
  std::string settings() const;
  std::string curves() const;

  std::string title_, x_label_, y_label_;
  std::vector<Series> series_;
  std::vector<std::pair<std::string, double>> marks_;
  double low_ = 0;
  double high_ = 0;  ///< equal to low_: the range is that of the data
};

}  // namespace redbee
