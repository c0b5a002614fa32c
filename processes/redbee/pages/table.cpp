#include "processes/redbee/pages/table.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "processes/redbee/pages/html.hpp"

namespace redbee {
namespace {

using Row = std::vector<std::string>;

std::vector<size_t> widthsOf(const Table& table) {
  std::vector<size_t> widths(table.columns.size());
  const auto widen = [&](const Row& row) {
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  };
  widen(table.columns);
  for (const Row& row : table.rows) widen(row);
  return widths;
}

std::string padded(const std::string& text, size_t width, bool left) {
  const std::string blanks(width - text.size(), ' ');
  return left ? text + blanks : blanks + text;
}

std::string line(const Row& row, const std::vector<size_t>& widths, const std::string& separator) {
  std::string text;
  for (size_t i = 0; i < row.size(); ++i)
    text += (i > 0 ? separator : "") + padded(row[i], widths[i], i == 0);
  return text;
}

std::string htmlRow(const Row& row, const std::string& element) {
  std::string text = "<tr>";
  for (const std::string& cell : row)
    text.append("<")
        .append(element)
        .append(">")
        .append(escapeHtml(cell))
        .append("</")
        .append(element)
        .append(">");
  return text + "</tr>\n";
}

}  // namespace

std::string asText(const Table& table) {
  const auto widths = widthsOf(table);
  std::string text = table.title + "\n" + line(table.columns, widths, "  ") + "\n";
  for (const Row& row : table.rows) text += line(row, widths, "  ") + "\n";
  for (const std::string& note : table.notes) text += "  " + note + "\n";
  return text;
}

std::string asMarkdown(const Table& table) {
  const auto widths = widthsOf(table);
  const auto marked = [&](const Row& row) { return "| " + line(row, widths, " | ") + " |\n"; };
  std::string text = "**" + table.title + "**\n\n" + marked(table.columns) + "|";
  for (size_t i = 0; i < widths.size(); ++i) text += i == 0 ? " --- |" : " ---: |";
  text += "\n";
  for (const Row& row : table.rows) text += marked(row);
  for (const std::string& note : table.notes) text += "\n" + note + "\n";
  return text;
}

std::string asHtml(const Table& table) {
  std::string text = "<h3>" + escapeHtml(table.title) + "</h3>\n<table>\n" + htmlRow(table.columns, "th");
  for (const Row& row : table.rows) text += htmlRow(row, "td");
  text += "</table>\n";
  for (const std::string& note : table.notes) text += "<p class=\"note\">" + escapeHtml(note) + "</p>\n";
  return text;
}

std::string formatted(const char* pattern, double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

}  // namespace redbee
