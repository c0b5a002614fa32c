#include "processes/redbee/pages/page.hpp"

#include "processes/redbee/pages/html.hpp"

namespace redbee {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.5 sans-serif;max-width:1240px;margin:2em auto;padding:0 1em;color:#222}\n"
    "h1{font-size:1.5em}h2{font-size:1.25em;margin-top:1.8em}h3{font-size:1.05em;margin:1.2em 0 .3em}\n"
    "small{color:#666;font-weight:normal;margin-left:.6em}\n"
    "table{display:block;max-width:100%;overflow-x:auto;border-collapse:collapse}\n"
    "td,th{padding:.2em .8em;border-bottom:1px solid #ddd;text-align:right;white-space:nowrap}\n"
    "td.text,th.text{text-align:left}td.text+td.text{white-space:normal}\n"
    ".note{color:#666;font-size:.9em;margin:.2em 0}\n"
    ".good{color:#1e8449}.weak{color:#b9770e}.bad{color:#c0392b}\n"
    ".figures{display:flex;flex-wrap:wrap;gap:6px}.figures figure{margin:0}\n"
    "figure img{width:100%;display:block}figcaption{font-size:.8em;color:#555}\n"
    ".plots{display:flex;flex-wrap:wrap;gap:6px;margin-bottom:6px}.plots svg{height:auto}\n"
    ".two>*{width:calc(50% - 3px)}.three>*{width:calc(33.3% - 4px)}.four>*{width:calc(25% - 5px)}\n";

std::string element(const std::string& name, const std::string& html, const char* style = "") {
  const std::string attribute = *style == '\0' ? "" : std::string(" class=\"") + style + "\"";
  return "<" + name + attribute + ">" + html + "</" + name + ">\n";
}

}  // namespace

Page::Page(const std::string& title)
    : head_("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n" +
            element("title", escapeHtml(title)) + element("style", kStyle) + "</head><body>\n"),
      body_(element("h1", escapeHtml(title))) {}

void Page::addHeading(const std::string& text) { body_ += element("h2", escapeHtml(text)); }

void Page::addSubheading(const std::string& text, const std::string& small_text) {
  const std::string small = small_text.empty() ? "" : element("small", escapeHtml(small_text));
  body_ += element("h3", escapeHtml(text) + small);
}

void Page::addParagraph(const std::string& text, TextStyle style) {
  body_ += element("p", escapeHtml(text), classOf(style));
}

void Page::addList(const std::vector<std::string>& items) {
  std::string html = "\n";
  for (const std::string& item : items) html += element("li", escapeHtml(item));
  body_ += element("ul", html);
}

void Page::addFigures(const std::vector<std::string>& figures, int in_a_row) {
  std::string html = "\n";
  for (const std::string& figure : figures) html += figure + "\n";
  body_ += element("div", html, in_a_row == 2 ? "figures two" : "figures four");
}

void Page::addPlots(const std::vector<std::string>& drawings, int in_a_row) {
  std::string html = "\n";
  for (const std::string& drawing : drawings) html += drawing + "\n";
  body_ += element("div", html, in_a_row == 2 ? "plots two" : "plots three");
}

std::string jpegFigure(std::string_view jpeg, const std::string& caption) {
  const std::string text = escapeHtml(caption);
  return "<figure><img alt=\"" + text + "\" src=\"data:image/jpeg;base64," + base64(jpeg) +
         "\"><figcaption>" + text + "</figcaption></figure>";
}

std::string legendEntry(const std::string& colour, const std::string& text) {
  return "<b style=\"color:" + colour + "\">" + escapeHtml(text) + "</b>";
}

}  // namespace redbee
