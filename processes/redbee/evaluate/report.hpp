// redbee report: one page of figures and images about a run.
#pragma once

#include <filesystem>

namespace redbee {

struct ReportOptions {
  std::filesystem::path log;
  std::filesystem::path configuration;
  std::filesystem::path results;  ///< see RunFolder
  std::filesystem::path truth;    ///< folder of ground-truth masks; empty: no measures
  std::filesystem::path page;     ///< the HTML file to write; it needs no other file
};

/// Also prints the figures. Throws InputError if a file cannot be read or written.
void writeReport(const ReportOptions& options);

}  // namespace redbee
