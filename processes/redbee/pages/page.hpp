// Self-contained HTML pages in one style, with embedded images and plots.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "processes/redbee/pages/table.hpp"

namespace redbee {

/// Elements are appended in the order in which they are shown. Text is escaped, `html` is not.
class Page {
 public:
  /// `title`: of the window and the first heading.
  explicit Page(const std::string& title);

  void addHeading(const std::string& text);
  void addSubheading(const std::string& text, const std::string& small_text = "");
  void addParagraph(const std::string& text, TextStyle style = TextStyle::kPlain);
  void addList(const std::vector<std::string>& items);
  void addTable(const Table& table) { body_ += asHtml(table); }
  /// Figures, see jpegFigure(), with so many in a row: 2 or 4.
  void addFigures(const std::vector<std::string>& figures, int in_a_row);
  /// SVG drawings, see SvgPlot, with so many in a row: 2 or 3.
  void addPlots(const std::vector<std::string>& drawings, int in_a_row);
  void addHtml(const std::string& html) { body_ += html + "\n"; }

  std::string html() const { return head_ + body_ + "</body></html>\n"; }

 private:
  std::string head_, body_;
};

/// A JPEG with its caption as a <figure> element.
std::string jpegFigure(std::string_view jpeg, const std::string& caption);
/// Coloured text for legends: a <b> element.
std::string legendEntry(const std::string& colour, const std::string& text);

}  // namespace redbee
