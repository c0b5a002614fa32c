// Which times of a recording cannot be true.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace redbee {

/// A gap of this length, in s, is none of a flight: a clock was set.
inline constexpr double kClockWasSet_s = 24 * 3600;

enum class TimeOrder {
  kSorted,      ///< the caller sorts
  kAsTheyCome,  ///< those that do not come after one another are left out, as few as can be
};

struct TimeFindings {
  std::vector<bool> keep;          ///< one for each time
  std::vector<std::string> lines;  ///< what is left out; each is to be preceded by the name of the source
};

/// `utimes`: us. A few that lie far from all others leap, as stamps of a driver that starts, or that were
/// damaged: they are left out. Throws InputError with `source` where too many are wrong, or where the
/// recording falls apart because a clock was set.
TimeFindings checkTimes(const std::vector<int64_t>& utimes, TimeOrder order, const std::string& source);

/// The rows for which `keep` has true, one for each.
template <typename Row>
std::vector<Row> thoseKept(const std::vector<Row>& rows, const std::vector<bool>& keep) {
  std::vector<Row> kept;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (keep[i]) kept.push_back(rows[i]);
  }
  return kept;
}

}  // namespace redbee
