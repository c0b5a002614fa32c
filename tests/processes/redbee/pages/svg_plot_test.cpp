#include "processes/redbee/pages/svg_plot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace redbee {
namespace {

TEST(SvgPlot, DrawsLinesPointsAndMarks) {
  SvgPlot plot("it's a title", "x, s", "y, px");
  plot.addLine("curve", {0, 1, 2}, {0, 1, 4}, "#c0392b");
  plot.addPoints("dots", {{0.5, 0.5}, {1.5, 2}}, "#1e8449");
  plot.addMark("here", 1);
  const std::string svg = plot.svg();
  EXPECT_EQ(svg.rfind("<svg", 0), 0u);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  for (const char* text : {"it's a title", "curve", "dots", "here", "y, px"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST(SvgPlot, InterruptsLinesAtNonFiniteValuesAndDrawsAnEmptyPlot) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SvgPlot broken("", "", "");
  broken.addLine("", {0, 1, 2, 3, 4}, {0, 1, nan, 1, 0}, "#123456");
  const std::string svg = broken.svg();
  const size_t start = svg.find("rgb( 18,  52,  86)'  d=");
  ASSERT_NE(start, std::string::npos);
  const std::string path = svg.substr(start, svg.find("/>", start) - start);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2) << path;
  SvgPlot empty("", "", "");
  empty.addLine("", {}, {}, "#000000");
  empty.addLine("", {1}, {nan}, "#000000");
  EXPECT_NE(empty.svg().find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace redbee
