// redbee compare: tables and report page of scripts/evaluate.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "processes/redbee/evaluate/comparison.hpp"
#include "processes/redbee/pages/table.hpp"

namespace redbee {

struct CompareOptions {
  std::filesystem::path cells;
  std::filesystem::path clips;    ///< clips file
  std::filesystem::path methods;  ///< methods file
  std::vector<std::string> extrinsics;
  std::filesystem::path out;
};

std::vector<Table> comparisonTables(const Comparison& comparison);
/// One line per clip, variant of the extrinsics, method and measure.
std::string comparisonCsv(const Comparison& comparison);
/// A self-contained page with the tables, the curves of each clip, and images of hits and misses.
std::string comparisonPage(const Comparison& comparison, const std::vector<Table>& tables);

/// Prints the tables; writes tables.txt, tables.md, cells.csv and report.html to the out folder.
void runCompare(const CompareOptions& options);

}  // namespace redbee
