#include <algorithm>
#include <array>
#include <vector>

#include "processes/redbee/evaluate/compare.hpp"
#include "processes/redbee/evaluate/measures_files.hpp"
#include "processes/redbee/evaluate/outcome_images.hpp"
#include "processes/redbee/pages/file_content.hpp"
#include "processes/redbee/pages/number.hpp"
#include "processes/redbee/pages/page.hpp"
#include "processes/redbee/pages/svg_plot.hpp"
#include "redbee/bus/build_version.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 10> kColours = {"#1f618d", "#c0392b", "#1e8449", "#d68910", "#7d3c98",
                                                  "#16a085", "#5d6d7e", "#a04000", "#e84393", "#000000"};

std::string curves(const Comparison& comparison, const ListedClip& clip, const std::string& row) {
  SvgPlot plot(clip.name, "recall", "precision");
  plot.makeSquare(0, 1);
  bool any = false;
  size_t colour = 0;
  for (const std::string& method : comparison.methods()) {
    const fs::path file = comparison.folder(clip, row, method) / "pr.csv";
    const char* const its_colour = kColours[colour++ % kColours.size()];
    if (!fs::exists(file)) continue;
    const RecallPrecision curve = readCurve(file);
    plot.addLine(method, curve.recall, curve.precision, its_colour);
    any = true;
  }
  return any ? plot.svg() : "";
}

std::string captionOf(const fs::path& image) {
  const std::string stem = image.stem().string();
  const size_t dash = stem.find('-');
  return stem.substr(0, dash) + " frame, " + stem.substr(dash + 1) + " us";
}

std::vector<std::string> figuresIn(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> figures;
  figures.reserve(files.size());
  for (const fs::path& file : files) figures.push_back(jpegFigure(contentOf(file), captionOf(file)));
  return figures;
}

std::string cellLine(const CellMeasures& cell) {
  std::string line;
  const auto add = [&](const char* label, const char* name, int decimals) {
    const auto value = cell.value(name);
    if (value) line += fmt::format("{}{} {}", line.empty() ? "" : ", ", label, fixed(*value, decimals));
  };
  add("Error@50%", "error_at_half_recall", 3);
  add("best F1", "best_f1", 3);
  add("objects found", "object_recall", 2);
  add("false area %", "false_area_percent", 3);
  return line;
}

void addSet(Page& page, const Comparison& comparison, const std::string& set, const std::string& row) {
  const std::string heading = row == kGivenExtrinsics ? set : set + ", extrinsics " + row;
  page.addHeading("Precision over recall: " + heading);
  std::vector<std::string> plots;
  for (const ListedClip& clip : comparison.clipsOf(set)) plots.push_back(curves(comparison, clip, row));
  page.addPlots(plots, 3);
  page.addHeading("Hits and misses: " + heading);
  page.addHtml(outcomeLegend());
  for (const ListedClip& clip : comparison.clipsOf(set)) {
    for (const std::string& method : comparison.methods()) {
      const CellMeasures* cell = comparison.cell(clip, row, method);
      if (cell == nullptr) continue;
      page.addSubheading(clip.name + ", " + method, cellLine(*cell));
      page.addFigures(figuresIn(comparison.folder(clip, row, method) / "images"), 4);
    }
  }
}

}  // namespace

std::string comparisonPage(const Comparison& comparison, const std::vector<Table>& tables) {
  Page page(std::string("REDBEE ") + releaseVersion() + ": evaluation");
  for (const Table& table : tables) page.addTable(table);
  for (const std::string& set : comparison.sets()) {
    for (const std::string& row : comparison.rowsOf(set)) addSet(page, comparison, set, row);
  }
  return page.html();
}

}  // namespace redbee
