#include "redbee/files/csv.hpp"

#include <charconv>
#include <cmath>

#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  size_t start = 0;
  while (true) {
    const size_t comma = line.find(',', start);
    fields.push_back(trimmed(line.substr(start, comma - start)));
    if (comma == std::string::npos) return fields;
    start = comma + 1;
  }
}

}  // namespace

CsvReader::CsvReader(std::filesystem::path path) : path_(std::move(path)) {
  requireFile(path_);
  file_.open(path_);
  if (!file_) throw InputError(path_, "cannot be opened");
}

bool CsvReader::next(size_t columns) {
  std::string line;
  while (std::getline(file_, line)) {
    ++line_;
    const std::string text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    fields_ = split(text);
    if (columns != 0 && fields_.size() != columns) {
      fail("has " + std::to_string(fields_.size()) + " columns instead of " + std::to_string(columns));
    }
    return true;
  }
  return false;
}

double CsvReader::number(size_t column) const {
  const std::string& text = fields_.at(column);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    fail("'" + text + "' in column " + std::to_string(column + 1) + " is no number");
  }
  if (!std::isfinite(value))
    fail("'" + text + "' in column " + std::to_string(column + 1) + " is not finite");
  return value;
}

int64_t CsvReader::integer(size_t column) const {
  const std::string& text = fields_.at(column);
  int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    fail("'" + text + "' in column " + std::to_string(column + 1) + " is no whole number");
  }
  return value;
}

void CsvReader::fail(const std::string& what) const { throw InputError(path_, line_, what); }

void IncreasingTimeCheck::check(const CsvReader& csv, int64_t utime) {
  if (any_ && utime == last_) csv.fail("its time repeats that of the row before");
  if (any_ && utime < last_) {
    csv.fail("time runs backwards by " + std::to_string(last_ - utime) + " us");
  }
  any_ = true;
  last_ = utime;
}

}  // namespace redbee
