// The times of a table's rows, which have to increase.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "redbee/files/csv.hpp"
#include "redbee/importers/time_check.hpp"

namespace redbee {

class RowTimes {
 public:
  /// To be called for each row, in its turn. us.
  void add(const CsvReader& csv, int64_t utime);

  /// Leaves out the rows whose times leap, with a line in `warnings`. Throws InputError where another time is
  /// not after the one before, with file and line, and where checkTimes() does.
  template <typename Row>
  void check(std::vector<Row>& rows, std::vector<std::string>& warnings) const {
    rows = thoseKept(rows, checkOrder(warnings));
  }

 private:
  std::vector<bool> checkOrder(std::vector<std::string>& warnings) const;

  std::filesystem::path file_;
  std::vector<int64_t> utimes_;
  std::vector<int> lines_;
};

}  // namespace redbee
