#include "processes/redbee/pages/table.hpp"

#include <gtest/gtest.h>

#include "processes/redbee/pages/number.hpp"

namespace redbee {
namespace {

TEST(Table, AlignsTextMarksUpMarkdownAndEscapesHtml) {
  const Table table{"T", {"method", "x"}, {{"a", "1.0"}, {"a<b", "10.0"}}, {"note"}};
  EXPECT_EQ(asText(table), "T\nmethod     x\na        1.0\na<b     10.0\n  note\n");
  EXPECT_EQ(asMarkdown(table),
            "**T**\n\n| method |    x |\n| --- | ---: |\n| a      |  1.0 |\n| a<b    | 10.0 |\n\nnote\n");
  EXPECT_NE(asHtml(table).find("<td class=\"text\">a&lt;b</td><td>10.0</td>"), std::string::npos);
}

TEST(Table, SetsTextColumnsToTheLeft) {
  Table table{"", {"name", "n", "comment"}, {{"a", "1", "good"}, {"b", "10", "poorer"}}, {}};
  table.text_columns = {0, 2};
  EXPECT_EQ(asText(table), "name   n  comment\na      1  good\nb     10  poorer\n");
  EXPECT_EQ(asMarkdown(table).substr(0, 44), "| name |  n | comment |\n| --- | ---: | --- |");
}

TEST(Table, ColoursCellsInHtml) {
  const Table table{"", {}, {{"found", Cell("yes", TextStyle::kGood)}}, {}};
  EXPECT_NE(asHtml(table).find("<td class=\"good\">yes</td>"), std::string::npos);
  EXPECT_EQ(asText(table), "found  yes\n");
}

TEST(Table, WithoutRowsShowsItsNotesOnly) {
  EXPECT_EQ(asHtml({"", {}, {}, {"nothing to show"}}), "<p class=\"note\">nothing to show</p>\n");
}

TEST(Number, HasTheDigitsAskedFor) {
  EXPECT_EQ(fixed(2.0 / 3, 3), "0.667");
  EXPECT_EQ(significant(2.0 / 3, 4), "0.6667");
  EXPECT_EQ(significant(1e-7, 4), "1e-07");
  EXPECT_EQ(std::stod(significant(0.1, 17)), 0.1);
}

}  // namespace
}  // namespace redbee
