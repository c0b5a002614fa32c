#include <algorithm>
#include <array>
#include <sstream>

#include "processes/redbee/evaluate/compare.hpp"
#include "processes/redbee/evaluate/measures_files.hpp"
#include "processes/redbee/pages/file_content.hpp"
#include "processes/redbee/pages/html.hpp"
#include "processes/redbee/pages/svg_plot.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStyle =
    "body{font:15px/1.5 sans-serif;max-width:1240px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse}td,th{padding:.2em .8em;border-bottom:1px solid #ddd;text-align:right;"
    "white-space:nowrap}td:first-child,th:first-child{text-align:left}.note{color:#666;font-size:.9em;margin:"
    ".2em 0}"
    ".curves "
    "svg{width:32%;height:auto}.images{display:flex;flex-wrap:wrap;gap:6px}figure{margin:0;width:24%}"
    "figure "
    "img{width:100%;display:block}figcaption{font-size:.8em;color:#555}h1{font-size:1.5em}h2{margin-top:2em}"
    "h3{margin-bottom:.3em}.hit{color:#3cbe46}.false{color:#eb3232}.miss{color:#1e78eb}.untold{color:#"
    "c9b000}";
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

std::string images(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::string html = "<div class=\"images\">\n";
  for (const fs::path& file : files) {
    html += "<figure>" + jpegElement(contentOf(file), captionOf(file)) + "<figcaption>" + captionOf(file) +
            "</figcaption></figure>\n";
  }
  return html + "</div>\n";
}

std::string cellLine(const CellMeasures& cell) {
  const auto add = [&](const char* label, const char* name, const char* pattern) {
    const auto value = cell.value(name);
    return value ? std::string(", ") + label + " " + formatted(pattern, *value) : "";
  };
  return add("Error@50%", "error_at_half_recall", "%.3f") + add("best F1", "best_f1", "%.3f") +
         add("objects found", "object_recall", "%.2f") + add("false area %", "false_area_percent", "%.3f");
}

void writeSet(std::ostream& html, const Comparison& comparison, const std::string& set,
              const std::string& row) {
  const std::string heading = row == kGivenExtrinsics ? set : set + ", extrinsics " + row;
  html << "<h2>Precision over recall: " << escapeHtml(heading) << "</h2>\n<div class=\"curves\">\n";
  for (const ListedClip& clip : comparison.clipsOf(set)) html << curves(comparison, clip, row);
  html << "</div>\n<h2>Hits and misses: " << escapeHtml(heading) << "</h2>\n"
       << "<p><b class=\"hit\">hit</b>, <b class=\"false\">false alarm</b>, <b class=\"miss\">missed</b>; "
          "<b class=\"untold\">detected where only boxes are labelled</b>; hatched: not known. By the mask "
          "that the "
          "method decided on.</p>\n";
  for (const ListedClip& clip : comparison.clipsOf(set)) {
    for (const std::string& method : comparison.methods()) {
      const CellMeasures* cell = comparison.cell(clip, row, method);
      if (cell == nullptr) continue;
      html << "<h3>" << escapeHtml(clip.name + ", " + method) << "<small>" << escapeHtml(cellLine(*cell))
           << "</small></h3>\n"
           << images(comparison.folder(clip, row, method) / "images");
    }
  }
}

}  // namespace

std::string comparisonPage(const Comparison& comparison, const std::vector<Table>& tables) {
  std::ostringstream html;
  html << "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>REDBEE evaluation</title><style>"
       << kStyle << "</style>\n<h1>REDBEE " REDBEE_VERSION ": evaluation</h1>\n";
  for (const Table& table : tables) html << asHtml(table);
  for (const std::string& set : comparison.sets()) {
    for (const std::string& row : comparison.rowsOf(set)) writeSet(html, comparison, set, row);
  }
  html << "</html>\n";
  return html.str();
}

}  // namespace redbee
