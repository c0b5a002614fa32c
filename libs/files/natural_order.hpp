// The order in which people number files: frame2 before frame10.
#pragma once

#include <cctype>
#include <filesystem>
#include <string>

namespace redbee {

/// True if `a` comes before `b`: runs of digits count as numbers, of any length.
inline bool isNaturallyBefore(const std::string& a, const std::string& b) {
  const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto digitsAt = [&](const std::string& text, size_t& at) {
    const size_t begin = at;
    while (at < text.size() && isDigit(text[at])) ++at;
    size_t first = begin;
    while (first + 1 < at && text[first] == '0') ++first;
    return text.substr(first, at - first);
  };
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (isDigit(a[i]) && isDigit(b[j])) {
      const std::string x = digitsAt(a, i);
      const std::string y = digitsAt(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  const bool is_a_shorter = a.size() - i < b.size() - j;
  return i == a.size() && j == b.size() ? a < b : is_a_shorter;
}

/// For the names of files in one folder.
inline bool isFileNaturallyBefore(const std::filesystem::path& a, const std::filesystem::path& b) {
  return isNaturallyBefore(a.string(), b.string());
}

}  // namespace redbee
