// redbee log repair: what is whole of a log, or of the parts of one, as one log.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace redbee {

struct LogRepair {
  int64_t messages = 0;
  std::vector<std::string> damage;  ///< one line for each file with damage, of its first
  std::string missing;              ///< a line about parts that are not among the files; empty if none is
};

/// Joins the files in the natural order of their names (F.lcm.2 before F.lcm.10), without what is damaged;
/// events keep times, channels and bytes, and are numbered anew. Throws InputError if a file is no log or
/// there twice, or if `out` is one of them.
LogRepair repairLog(std::vector<std::filesystem::path> parts, const std::filesystem::path& out);

}  // namespace redbee
