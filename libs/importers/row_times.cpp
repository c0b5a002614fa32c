#include "redbee/importers/row_times.hpp"

#include "redbee/files/input_error.hpp"

namespace redbee {

void RowTimes::add(const CsvReader& csv, int64_t utime) {
  file_ = csv.path();
  utimes_.push_back(utime);
  lines_.push_back(csv.line());
}

std::vector<bool> RowTimes::checkOrder(std::vector<std::string>& warnings) const {
  const TimeFindings findings = checkTimes(utimes_, TimeOrder::kSorted, file_.string());
  for (const std::string& line : findings.lines) warnings.push_back(file_.string() + ": " + line);
  const int64_t* before = nullptr;
  for (size_t i = 0; i < utimes_.size(); ++i) {
    if (!findings.keep[i]) continue;
    if (before != nullptr && utimes_[i] == *before)
      throw InputError(file_, lines_[i], "its time repeats that of the row before");
    if (before != nullptr && utimes_[i] < *before) {
      throw InputError(file_, lines_[i],
                       "time runs backwards by " + std::to_string(*before - utimes_[i]) + " us");
    }
    before = &utimes_[i];
  }
  return findings.keep;
}

}  // namespace redbee
