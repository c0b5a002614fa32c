#include "processes/redbee/pages/table.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "processes/redbee/pages/html.hpp"

namespace redbee {
namespace {

using Row = std::vector<Cell>;

Row headingsOf(const Table& table) { return {table.columns.begin(), table.columns.end()}; }

bool isText(const Table& table, size_t column) {
  return std::count(table.text_columns.begin(), table.text_columns.end(), column) > 0;
}

/// Pads the cells of each column to one width.
class Alignment {
 public:
  explicit Alignment(const Table& table) : table_(table) {
    widen(headingsOf(table));
    for (const Row& row : table.rows) widen(row);
  }

  std::string line(const Row& row, const std::string& separator) const {
    std::string text;
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string blanks(widths_[i] - row[i].text.size(), ' ');
      text += i > 0 ? separator : "";
      text += isText(table_, i) ? row[i].text + blanks : blanks + row[i].text;
    }
    return text;
  }
  size_t columns() const { return widths_.size(); }

 private:
  void widen(const Row& row) {
    widths_.resize(std::max(widths_.size(), row.size()));
    for (size_t i = 0; i < row.size(); ++i) widths_[i] = std::max(widths_[i], row[i].text.size());
  }

  const Table& table_;
  std::vector<size_t> widths_;
};

std::string withoutTrailingBlanks(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

std::string htmlRow(const Table& table, const Row& row, const std::string& element) {
  std::string html = "<tr>";
  for (size_t i = 0; i < row.size(); ++i) {
    std::string classes = isText(table, i) ? "text" : "";
    if (row[i].style != TextStyle::kPlain)
      classes += std::string(classes.empty() ? "" : " ") + classOf(row[i].style);
    const std::string attribute = classes.empty() ? "" : " class=\"" + classes + "\"";
    html += fmt::format("<{}{}>{}</{}>", element, attribute, escapeHtml(row[i].text), element);
  }
  return html + "</tr>\n";
}

}  // namespace

const char* classOf(TextStyle style) {
  switch (style) {
    case TextStyle::kPlain:
      return "";
    case TextStyle::kNote:
      return "note";
    case TextStyle::kGood:
      return "good";
    case TextStyle::kWeak:
      return "weak";
    case TextStyle::kBad:
      return "bad";
  }
  return "";
}

std::string asText(const Table& table) {
  const Alignment alignment(table);
  std::string text = table.title.empty() ? "" : table.title + "\n";
  const auto add = [&](const Row& row) { text += withoutTrailingBlanks(alignment.line(row, "  ")) + "\n"; };
  if (!table.columns.empty()) add(headingsOf(table));
  for (const Row& row : table.rows) add(row);
  for (const std::string& note : table.notes) text += "  " + note + "\n";
  return text;
}

std::string asMarkdown(const Table& table) {
  const Alignment alignment(table);
  const auto marked = [&](const Row& row) { return "| " + alignment.line(row, " | ") + " |\n"; };
  std::string text = table.title.empty() ? "" : "**" + table.title + "**\n\n";
  // Markdown knows no table without headings.
  text += marked(table.columns.empty() ? Row(alignment.columns(), "") : headingsOf(table)) + "|";
  for (size_t i = 0; i < alignment.columns(); ++i) text += isText(table, i) ? " --- |" : " ---: |";
  text += "\n";
  for (const Row& row : table.rows) text += marked(row);
  for (const std::string& note : table.notes) text += "\n" + note + "\n";
  return text;
}

std::string asHtml(const Table& table) {
  std::string html = table.title.empty() ? "" : "<h3>" + escapeHtml(table.title) + "</h3>\n";
  if (!table.columns.empty() || !table.rows.empty()) {
    html += "<table>\n";
    if (!table.columns.empty()) html += htmlRow(table, headingsOf(table), "th");
    for (const Row& row : table.rows) html += htmlRow(table, row, "td");
    html += "</table>\n";
  }
  for (const std::string& note : table.notes) html += "<p class=\"note\">" + escapeHtml(note) + "</p>\n";
  return html;
}

}  // namespace redbee
