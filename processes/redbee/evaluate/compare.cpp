#include "processes/redbee/evaluate/compare.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "processes/redbee/commands/commands.hpp"
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

void addCompareCommand(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  auto* command = app.add_subcommand("compare", "tables and a page of what scripts/evaluate has run");
  command->add_option("--cells", options->cells, "folder of results, SET/CLIP/EXTRINSICS/METHOD")->required();
  command->add_option("--clips", options->clips, "the clips file")->required();
  command->add_option("--methods", options->methods, "the methods file")->required();
  command->add_option("--extrinsics", options->extrinsics, "rows of extrinsics, separated by commas")
      ->delimiter(',')
      ->required();
  command->add_option("--out", options->out, "folder for the tables and the page")->required();
  command->callback([options] { runCompare(*options); });
}

}  // namespace redbee
