// Tables as aligned text, Markdown and HTML.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace redbee {

/// Styles of text, shown as colours where available.
enum class TextStyle { kPlain, kNote, kGood, kWeak, kBad };
/// Class of an HTML element; empty: none.
const char* classOf(TextStyle style);

struct Cell {
  Cell(std::string cell_text,
       TextStyle cell_style = TextStyle::kPlain)  // NOLINT(google-explicit-constructor): a text is a cell
      : text(std::move(cell_text)), style(cell_style) {}
  Cell(const char* cell_text) : text(cell_text) {}  // NOLINT(google-explicit-constructor)

  std::string text;
  TextStyle style = TextStyle::kPlain;
};

/// Every row has as many cells as there are columns.
struct Table {
  std::string title;                 ///< empty: none
  std::vector<std::string> columns;  ///< headings; empty: no headings
  std::vector<std::vector<Cell>> rows;
  std::vector<std::string> notes;          ///< lines below
  std::vector<size_t> text_columns = {0};  ///< left-aligned; the others, with numbers, are right-aligned
};

std::string asText(const Table& table);
std::string asMarkdown(const Table& table);
std::string asHtml(const Table& table);

}  // namespace redbee
