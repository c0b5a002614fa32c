// Tables for people: aligned text, Markdown and HTML of the same cells.
#pragma once

#include <string>
#include <vector>

namespace redbee {

/// The first column is set to the left, the others to the right. Every row has as many cells as `columns`.
struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> notes;  ///< lines below
};

std::string asText(const Table& table);
std::string asMarkdown(const Table& table);
std::string asHtml(const Table& table);

/// Like printf, for a cell.
std::string formatted(const char* pattern, double value);

}  // namespace redbee
