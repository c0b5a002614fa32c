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

/// Without the quotes around it; a quote inside is doubled.
std::string unquoted(const std::string& field) {
  std::string text = trimmed(field);
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') return text;
  std::string out;
  for (size_t i = 1; i + 1 < text.size(); ++i) {
    out += text[i];
    if (text[i] == '"' && i + 2 < text.size() && text[i + 1] == '"') ++i;
  }
  return trimmed(out);
}

/// 0 where the line has none. Tabs that follow commas only align the columns.
char separatorIn(const std::string& line) {
  if (line.find(';') != std::string::npos) return ';';
  for (size_t tab = line.find('\t'); tab != std::string::npos; tab = line.find('\t', tab + 1)) {
    const size_t before = line.find_last_not_of(" \t", tab);
    if (before != std::string::npos && line[before] != ',') return '\t';
  }
  return line.find(',') != std::string::npos ? ',' : char{0};
}

/// std::from_chars() takes no plus, and a point only.
std::string plainNumber(std::string text, char separator) {
  if (text.size() > 1 && text.front() == '+') text.erase(0, 1);
  if (separator == ',' || text.find('.') != std::string::npos) return text;
  const size_t comma = text.find(',');
  if (comma != std::string::npos) text[comma] = '.';
  return text;
}

bool startsLikeNumber(const std::string& text) {
  const size_t first = text.find_first_not_of("+-.,");
  return first != std::string::npos && text[first] >= '0' && text[first] <= '9';
}

/// Names of columns may stand in a comment.
std::string withoutHash(const std::string& line) { return trimmed(line.substr(line.find_first_not_of('#'))); }

}  // namespace

CsvReader::CsvReader(std::filesystem::path path) : path_(std::move(path)) {
  requireFile(path_);
  file_.open(path_);
  if (!file_) throw InputError(path_, "cannot be opened");
}

bool CsvReader::next(size_t columns) {
  if (!is_pending_ && !readRow()) return false;
  is_pending_ = false;
  if (columns != 0 && fields_.size() != columns) {
    fail("has " + std::to_string(fields_.size()) + " columns instead of " + std::to_string(columns));
  }
  return true;
}

void CsvReader::skipHeader() {
  if (!readRow()) return;
  is_pending_ = startsLikeNumber(fields_.front());
  if (!is_pending_) header_ = fields_;
}

bool CsvReader::readRow() {
  std::string line;
  while (std::getline(file_, line, line_end_)) {
    const size_t carriage_return = line.find('\r');
    const bool ends_within = carriage_return != std::string::npos &&
                             line.find_first_not_of('\r', carriage_return) != std::string::npos;
    if (line_ == 0 && ends_within) {
      line_end_ = '\r';
      file_.clear();
      file_.seekg(0);
      std::getline(file_, line, line_end_);
    }
    if (line.find('\0') != std::string::npos) throw InputError(path_, "is no table: it holds binary data");
    const std::string byte_order_mark = "\xEF\xBB\xBF";
    if (++line_ == 1 && line.rfind(byte_order_mark, 0) == 0) line.erase(0, byte_order_mark.size());
    const std::string text = trimmed(line);
    if (text.empty()) continue;
    if (text.front() != '#') {
      fields_ = split(line);
      return true;
    }
    if (fields_.empty() && text.find_first_not_of('#') != std::string::npos) {
      header_ = split(withoutHash(text));
      separator_ = 0;  // a comment decides nothing for what follows
    }
  }
  return false;
}

std::vector<std::string> CsvReader::split(const std::string& line) {
  if (separator_ == 0) separator_ = separatorIn(line);
  std::vector<std::string> fields;
  std::string field;
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') is_quoted = !is_quoted;
    if (c == separator_ && !is_quoted && separator_ != 0) {
      fields.push_back(unquoted(field));
      field.clear();
    } else {
      field += c;
    }
  }
  fields.push_back(unquoted(field));
  return fields;
}

double CsvReader::number(size_t column) const {
  const std::string text = plainNumber(fields_.at(column), separator_);
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
  const std::string text = plainNumber(fields_.at(column), separator_);
  int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    const bool is_rounded = text.find_first_of("eE") != std::string::npos && startsLikeNumber(text);
    fail("'" + text + "' in column " + std::to_string(column + 1) + " is no whole number" +
         (is_rounded ? ": a spreadsheet has rounded it; take the file as it was recorded" : ""));
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
