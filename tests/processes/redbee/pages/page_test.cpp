#include "processes/redbee/pages/page.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

TEST(Page, NeedsNoOtherFileAndEscapesText) {
  Page page("a < b");
  page.addHeading("x & y");
  page.addParagraph("careful", TextStyle::kWeak);
  page.addList({"one", "two"});
  page.addTable({"", {"name", "value"}, {{"n", "1"}}, {}});
  page.addFigures({jpegFigure("jpeg", "frame 7")}, 2);
  const std::string html = page.html();
  for (const char* part : {"<title>a &lt; b</title>", "<h1>a &lt; b</h1>", "<h2>x &amp; y</h2>",
                           "<p class=\"weak\">careful</p>", "<li>two</li>", "<td>1</td>",
                           "data:image/jpeg;base64,anBlZw==", "<figcaption>frame 7</figcaption>"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  for (const char* outside : {"src=\"/", "href=", "http"}) {
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
  }
}

}  // namespace
}  // namespace redbee
