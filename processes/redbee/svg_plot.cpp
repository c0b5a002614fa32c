#include "processes/redbee/svg_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>
#include <utility>

namespace redbee {
namespace {

constexpr double kHeight = 300, kLeft = 64, kRight = 12, kTop = 44, kBottom = 44;
constexpr double kWideWidth = 900, kSquareWidth = 440, kSquareHeight = 440;

std::string number(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// 1, 2 or 5 times a power of ten, so that about six ticks fit.
double tickStep(double span) {
  const double rough = span / 6;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10 * power;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '&')
      result += "&amp;";
    else
      result += c;
  }
  return result;
}

std::string textAt(double x, double y, const std::string& text, const std::string& attributes) {
  return "<text x=\"" + number(x, "%.1f") + "\" y=\"" + number(y, "%.1f") + "\" " + attributes + ">" +
         escaped(text) + "</text>\n";
}

std::string lineBetween(double x1, double y1, double x2, double y2, const std::string& attributes) {
  return "<line x1=\"" + number(x1, "%.1f") + "\" y1=\"" + number(y1, "%.1f") + "\" x2=\"" +
         number(x2, "%.1f") + "\" y2=\"" + number(y2, "%.1f") + "\" " + attributes + "/>\n";
}

}  // namespace

SvgPlot::SvgPlot(std::string title, std::string x_label, std::string y_label)
    : title_(std::move(title)), x_label_(std::move(x_label)), y_label_(std::move(y_label)) {}

void SvgPlot::addLine(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
                      const std::string& colour) {
  Series series{name, {}, colour, true};
  for (size_t i = 0; i < std::min(x.size(), y.size()); ++i) series.points.emplace_back(x[i], y[i]);
  series_.push_back(std::move(series));
}

void SvgPlot::addPoints(const std::string& name, const std::vector<Eigen::Vector2d>& points,
                        const std::string& colour) {
  series_.push_back({name, points, colour, false});
}

void SvgPlot::addMark(const std::string& name, double x) { marks_.emplace_back(name, x); }

void SvgPlot::makeSquare(double reach) { reach_ = reach; }

SvgPlot::Range SvgPlot::rangeOf(int axis) const {
  if (reach_ > 0) return {-reach_, reach_};
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Series& series : series_) {
    for (const Eigen::Vector2d& point : series.points) {
      if (!point.allFinite()) continue;
      range.low = std::min(range.low, point[axis]);
      range.high = std::max(range.high, point[axis]);
    }
  }
  if (!(range.low <= range.high)) return {0, 1};
  const double span = range.high - range.low;
  const double margin = axis == 1 ? 0.05 * span : 0.0;
  if (span <= 0) return {range.low - 0.5, range.high + 0.5};
  return {range.low - margin, range.high + margin};
}

std::string SvgPlot::svg() const {
  const double width = reach_ > 0 ? kSquareWidth : kWideWidth;
  const double height = reach_ > 0 ? kSquareHeight : kHeight;
  const Range x_range = rangeOf(0);
  const Range y_range = rangeOf(1);
  const double right = width - kRight, bottom = height - kBottom;
  const auto px = [&](double x) { return kLeft + x_range.share(x) * (right - kLeft); };
  const auto py = [&](double y) { return bottom - y_range.share(y) * (bottom - kTop); };

  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
      << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
         "fill=\"white\"/>\n"
      << textAt(kLeft, 16, title_, "font-weight=\"bold\"");
  const double x_step = tickStep(x_range.high - x_range.low), y_step = tickStep(y_range.high - y_range.low);
  for (double x = std::ceil(x_range.low / x_step) * x_step; x <= x_range.high + 1e-9 * x_step; x += x_step) {
    out << lineBetween(px(x), kTop, px(x), bottom, "stroke=\"#eee\"")
        << textAt(px(x), bottom + 16, number(std::abs(x) < 1e-9 * x_step ? 0.0 : x, "%g"),
                  "text-anchor=\"middle\"");
  }
  for (double y = std::ceil(y_range.low / y_step) * y_step; y <= y_range.high + 1e-9 * y_step; y += y_step) {
    out << lineBetween(kLeft, py(y), right, py(y), "stroke=\"#eee\"")
        << textAt(kLeft - 6, py(y) + 4, number(std::abs(y) < 1e-9 * y_step ? 0.0 : y, "%g"),
                  "text-anchor=\"end\"");
  }
  out << textAt((kLeft + right) / 2, height - 8, x_label_, "text-anchor=\"middle\"")
      << "<text transform=\"translate(14," << (kTop + bottom) / 2 << ") rotate(-90)\" text-anchor=\"middle\">"
      << escaped(y_label_) << "</text>\n";

  double legend = kLeft;
  for (const Series& series : series_) {
    out << textAt(legend, 34, series.name, "fill=\"" + series.colour + "\"");
    legend += 7.0 * static_cast<double>(series.name.size()) + 18;
    if (series.line) {
      out << "<path fill=\"none\" stroke=\"" << series.colour << "\" d=\"";
      bool pen_down = false;
      for (const Eigen::Vector2d& point : series.points) {
        if (!point.allFinite()) {
          pen_down = false;
          continue;
        }
        out << (pen_down ? 'L' : 'M') << number(px(point.x()), "%.1f") << ' '
            << number(py(point.y()), "%.1f");
        pen_down = true;
      }
      out << "\"/>\n";
      continue;
    }
    for (const Eigen::Vector2d& point : series.points) {
      const double sx = x_range.share(point.x()), sy = y_range.share(point.y());
      if (!(sx >= 0 && sx <= 1 && sy >= 0 && sy <= 1)) continue;
      out << "<circle cx=\"" << number(px(point.x()), "%.1f") << "\" cy=\"" << number(py(point.y()), "%.1f")
          << "\" r=\"1.2\" fill-opacity=\"0.4\" fill=\"" << series.colour << "\"/>\n";
    }
  }
  for (const auto& [name, x] : marks_) {
    out << lineBetween(px(x), kTop, px(x), bottom, "stroke=\"#555\" stroke-dasharray=\"4 3\"")
        << textAt(px(x) + 4, kTop + 12, name, "fill=\"#555\"");
  }
  out << "<rect x=\"" << kLeft << "\" y=\"" << kTop << "\" width=\"" << right - kLeft << "\" height=\""
      << bottom - kTop << "\" fill=\"none\" stroke=\"#888\"/>\n</svg>\n";
  return out.str();
}

}  // namespace redbee
