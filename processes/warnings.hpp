// Warnings of the programs: a line each on stderr.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "redbee/files/printable.hpp"

namespace redbee {

/// Nothing for an empty line.
inline void printWarning(const std::string& line) {
  if (!line.empty()) std::fprintf(stderr, "warning: %s\n", printable(line).c_str());
}
inline void printWarnings(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) printWarning(line);
}
inline void printDamaged(int64_t messages) {
  if (messages > 0) printWarning(std::to_string(messages) + " damaged messages are left out");
}

}  // namespace redbee
