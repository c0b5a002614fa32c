#include "processes/redbee/evaluate/compare.hpp"

#include <cstdio>

#include "processes/redbee/pages/svg_plot.hpp"
#include "redbee/files/atomic_file.hpp"

namespace redbee {

void runCompare(const CompareOptions& options) {
  SvgPlot::checkInstalled();
  const Comparison comparison(options.cells, readClipList(options.clips), readMethodList(options.methods),
                              options.extrinsics);
  const std::vector<Table> tables = comparisonTables(comparison);
  std::string text, markdown;
  for (const Table& table : tables) {
    text += asText(table) + "\n";
    markdown += asMarkdown(table) + "\n";
  }
  std::filesystem::create_directories(options.out);
  writeAtomically(options.out / "tables.txt", text);
  writeAtomically(options.out / "tables.md", markdown);
  writeAtomically(options.out / "cells.csv", comparisonCsv(comparison));
  writeAtomically(options.out / "report.html", comparisonPage(comparison, tables));
  std::printf("%s%s\n", text.c_str(), (options.out / "report.html").c_str());
}

}  // namespace redbee
