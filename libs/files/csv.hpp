// Reads numbers from CSV files; errors name file and line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace redbee {

/// Reads a CSV file row by row. Empty lines and lines that start with '#' (the ASL layout's headers) are
/// skipped.
class CsvReader {
 public:
  /// Throws InputError if the file cannot be opened.
  explicit CsvReader(std::filesystem::path path);

  /// Returns false at the end of the file. Throws InputError if the row does not have `columns` fields (0:
  /// any number).
  bool next(size_t columns);
  const std::vector<std::string>& fields() const { return fields_; }
  /// The field as a finite number, or as an integer. Throws InputError otherwise.
  double number(size_t column) const;
  int64_t integer(size_t column) const;
  int line() const { return line_; }
  const std::filesystem::path& path() const { return path_; }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::filesystem::path path_;
  std::ifstream file_;
  std::vector<std::string> fields_;
  int line_ = 0;
};

/// Throws InputError for times that do not strictly increase.
class IncreasingTimeCheck {
 public:
  void check(const CsvReader& csv, int64_t utime);

 private:
  bool any_ = false;
  int64_t last_ = 0;
};

}  // namespace redbee
