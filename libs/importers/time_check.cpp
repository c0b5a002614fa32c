#include "redbee/importers/time_check.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "redbee/files/input_error.hpp"

namespace redbee {
namespace {

using Times = std::vector<int64_t>;
using Places = std::vector<size_t>;

/// Difference of two times, whatever they are.
double span_s(int64_t from, int64_t to) {
  return 1e-6 * (static_cast<double>(to) - static_cast<double>(from));
}

/// Places of the times, in runs without a large gap, by time.
std::vector<Places> runsOf(const Times& utimes) {
  Places order(utimes.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return utimes[a] < utimes[b]; });
  std::vector<double> gaps;
  for (size_t i = 1; i < order.size(); ++i) gaps.push_back(span_s(utimes[order[i - 1]], utimes[order[i]]));
  if (gaps.empty()) return {order};
  // A recording may pause, as a phone's does in the background, and a time lapse has long periods.
  constexpr double kPeriods = 1000;
  std::vector<double> sorted = gaps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2), sorted.end());
  const double large_s = std::max(kClockWasSet_s, kPeriods * sorted[sorted.size() / 2]);
  std::vector<Places> runs{{order.front()}};
  for (size_t i = 0; i < gaps.size(); ++i) {
    if (gaps[i] > large_s) runs.emplace_back();
    runs.back().push_back(order[i + 1]);
  }
  return runs;
}

/// So few that they tell nothing of the flight.
bool isAHandful(const Places& run, size_t all) {
  constexpr size_t kHandful = 3, kPart = 100, kMostPart = 4;
  return run.size() <= std::max(kHandful, all / kPart) && run.size() * kMostPart <= all;
}

void leaveOutLeaps(const Times& utimes, const std::string& source, TimeFindings& findings) {
  size_t first = utimes.size();
  int64_t count = 0;
  const int64_t* last_kept = nullptr;
  for (const Places& run : runsOf(utimes)) {
    if (isAHandful(run, utimes.size())) {
      for (const size_t place : run) findings.keep[place] = false;
      count += static_cast<int64_t>(run.size());
      first = std::min(first, *std::min_element(run.begin(), run.end()));
      continue;
    }
    const double gap_s = last_kept == nullptr ? 0 : span_s(*last_kept, utimes[run.front()]);
    if (gap_s > kClockWasSet_s) {
      throw InputError(
          fmt::format("{}: times leap by {:.0f} s at number {}: the clock was set during the recording; "
                      "cut it there",
                      source, gap_s, *std::min_element(run.begin(), run.end()) + 1));
    }
    last_kept = &utimes[run.back()];
  }
  if (count == 0) return;
  const auto kept = std::find(findings.keep.begin(), findings.keep.end(), true);
  size_t beside = static_cast<size_t>(kept - findings.keep.begin());
  for (size_t i = 0; i < first; ++i) {
    if (findings.keep[i]) beside = i;
  }
  findings.lines.push_back(
      fmt::format("{} of {} times leap, the first (number {}) by {:.3f} s: they are left out", count,
                  utimes.size(), first + 1, span_s(utimes[beside], utimes[first])));
}

/// Of the longest sequence of times that increase, among those that are kept.
Places longestIncrease(const Times& utimes, const std::vector<bool>& keep) {
  Places ends;  // of the sequences of each length, that with the least time
  std::vector<size_t> before(utimes.size(), utimes.size());
  for (size_t i = 0; i < utimes.size(); ++i) {
    if (!keep[i]) continue;
    const auto at = std::lower_bound(ends.begin(), ends.end(), utimes[i],
                                     [&](size_t end, int64_t utime) { return utimes[end] < utime; });
    if (at != ends.begin()) before[i] = *std::prev(at);
    if (at == ends.end()) {
      ends.push_back(i);
    } else {
      *at = i;
    }
  }
  Places sequence;
  for (size_t i = ends.empty() ? utimes.size() : ends.back(); i < utimes.size(); i = before[i])
    sequence.push_back(i);
  return {sequence.rbegin(), sequence.rend()};
}

void keepWhatIncreases(const Times& utimes, const std::string& source, TimeFindings& findings) {
  constexpr double kMostBackwards = 0.1;
  const Places sequence = longestIncrease(utimes, findings.keep);
  std::set<int64_t> times;
  std::vector<bool> keep(utimes.size());
  for (const size_t place : sequence) {
    keep[place] = true;
    times.insert(utimes[place]);
  }
  int64_t repeated = 0, backwards = 0;
  for (size_t i = 0; i < utimes.size(); ++i) {
    if (keep[i] || !findings.keep[i]) continue;
    ++(times.count(utimes[i]) > 0 ? repeated : backwards);
  }
  findings.keep = std::move(keep);
  if (static_cast<double>(backwards) > kMostBackwards * static_cast<double>(utimes.size())) {
    throw InputError(
        fmt::format("{}: {} of {} times run backwards: two recordings in one, or a clock that was set; "
                    "cut it there",
                    source, backwards, utimes.size()));
  }
  if (repeated + backwards > 0) {
    findings.lines.push_back(fmt::format("{} of {} do not come after the one before and are left out",
                                         repeated + backwards, utimes.size()));
  }
}

}  // namespace

TimeFindings checkTimes(const Times& utimes, TimeOrder order, const std::string& source) {
  TimeFindings findings;
  findings.keep.assign(utimes.size(), true);
  if (utimes.empty()) return findings;
  leaveOutLeaps(utimes, source, findings);
  if (order == TimeOrder::kAsTheyCome) keepWhatIncreases(utimes, source, findings);
  return findings;
}

}  // namespace redbee
