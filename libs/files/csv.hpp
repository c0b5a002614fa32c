// Reads numbers from CSV files; errors name file and line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace redbee {

/// Reads a CSV file row by row. Empty lines and lines that start with '#' (the ASL layout's headers) are
/// skipped. The first line with a separator decides which it is: semicolon, tab or comma; with the first two
/// a decimal comma is read as a point. A byte order mark and quotes around fields are left out; lines may end
/// as on old Macs.
class CsvReader {
 public:
  /// Throws InputError if the file cannot be opened.
  explicit CsvReader(std::filesystem::path path);

  /// Returns false at the end of the file. Throws InputError if the row does not have `columns` fields (0:
  /// any number).
  bool next(size_t columns);
  /// To be called before the first next(): skips a row of names, if there is one before the first number.
  void skipHeader();
  /// The names of the columns: of the row that skipHeader() skipped, or of a comment before it; may be empty.
  const std::vector<std::string>& header() const { return header_; }
  /// Of the header, or of the latest row.
  size_t columns() const { return header_.empty() ? fields_.size() : header_.size(); }
  const std::vector<std::string>& fields() const { return fields_; }
  /// The field as a finite number, or as an integer. Throws InputError otherwise.
  double number(size_t column) const;
  int64_t integer(size_t column) const;
  int line() const { return line_; }
  const std::filesystem::path& path() const { return path_; }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool readRow();
  std::vector<std::string> split(const std::string& line);

  std::filesystem::path path_;
  std::ifstream file_;
  std::vector<std::string> fields_;
  std::vector<std::string> header_;
  char line_end_ = '\n';
  char separator_ = 0;  ///< 0: not known yet
  bool is_pending_ = false;
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
