#include "processes/redbee/evaluate/comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "processes/redbee/evaluate/compare.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

class ComparisonTest : public testing::Test {
 protected:
  ComparisonTest() {
    writeText(folder_ / "clips.txt",
              "# set name import recording truth configuration\nflown a asl r t extrinsics\nflown b asl r t "
              "extrinsics\n"
              "still  c log r none config/c.yaml\n");
    writeText(folder_ / "methods.txt", "ours redbee\nold  paper  a.b=1\n");
  }
  void writeCell(const std::string& cell, const std::string& error, const std::string& f1) {
    writeText(folder_ / "cells" / cell / "measures.json",
              R"({"pixels": {"error_at_half_recall": )" + error + R"(, "best_f1": )" + f1 +
                  R"(}, "objects": {"false_area_percent": 0.5, "false_alarms_per_frame": 2}})");
    writeText(folder_ / "cells" / cell / "summary.json", R"({"frames": 100, "fps": 20})");
  }
  Comparison comparison() const {
    return {folder_ / "cells",
            readClipList(folder_ / "clips.txt"),
            readMethodList(folder_ / "methods.txt"),
            {"calibrated", "nominal"}};
  }
  /// The cells of a method behind its name, in the table with this title; empty if there is none.
  std::vector<std::string> row(const std::string& title, const std::string& method) const {
    for (const Table& table : comparisonTables(comparison())) {
      for (const std::vector<Cell>& cells : table.rows) {
        if (table.title != title || cells.front().text != method) continue;
        std::vector<std::string> texts;
        texts.reserve(cells.size());
        for (const Cell& cell : cells) texts.push_back(cell.text);
        texts.erase(texts.begin());
        return texts;
      }
    }
    return {};
  }
  std::set<std::string> notes() const {
    std::set<std::string> all;
    for (const Table& table : comparisonTables(comparison()))
      all.insert(table.notes.begin(), table.notes.end());
    return all;
  }
  ScratchFolder folder_;
};

using Texts = std::vector<std::string>;
const std::string kAccuracy = "flown, extrinsics calibrated: Error@50% / best F1";

TEST_F(ComparisonTest, TablesHoldTheCellsAndTheirMeans) {
  writeCell("flown/a/calibrated/ours", "0.2", "0.8");
  writeCell("flown/b/calibrated/ours", "0.4", "0.6");
  writeCell("flown/a/nominal/ours", "0.9", "0.1");
  writeCell("flown/a/calibrated/old", "1.0", "0.0");
  EXPECT_EQ(row(kAccuracy, "ours"), (Texts{"0.200 / 0.800", "0.400 / 0.600", "0.300 / 0.700"}));
  EXPECT_EQ(row(kAccuracy, "old"), (Texts{"1.000 / 0.000", "-", "1.000 / 0.000"}));
  EXPECT_EQ(row("flown: Error@50% / best F1, mean over clips, by extrinsics", "ours"),
            (Texts{"0.300 / 0.700", "0.900 / 0.100"}));
  EXPECT_EQ(notes().count("1 runs have no result; the means are without them"), 1U);
}

TEST_F(ComparisonTest, MeasuresUndefinedWithThisTruthAreLeftOut) {
  writeCell("still/c/given/ours", "null", "null");
  EXPECT_EQ(row("still: objects found % / false alarms per frame / their area, % of the image", "ours").at(0),
            "- / 2.00 / 0.500");
  EXPECT_TRUE(row("still: Error@50% / best F1", "ours").empty());
}

TEST_F(ComparisonTest, FramerateIsAllFramesOverAllTime) {
  writeCell("flown/a/calibrated/ours", "0.2", "0.8");
  writeCell("flown/b/calibrated/ours", "0.2", "0.8");
  writeText(folder_ / "cells/flown/b/calibrated/ours/summary.json", R"({"frames": 300, "fps": 30})");
  // 400 frames in 15 s
  EXPECT_EQ(row("flown, extrinsics calibrated: cost beside accuracy", "ours").at(0), "26.7");
}

TEST_F(ComparisonTest, NotesAMethodThatWasRunOnFewerFrames) {
  writeCell("flown/a/calibrated/ours", "0.2", "0.8");
  writeCell("flown/a/calibrated/old", "0.2", "0.8");
  writeText(folder_ / "cells/flown/a/calibrated/old/measures.json",
            R"({"frames_limit": 40, "pixels": {"error_at_half_recall": 0.2, "best_f1": 0.8}})");
  const std::set<std::string> all = notes();
  EXPECT_EQ(all.count("old: only the first 40 frames of each clip"), 1U);
  EXPECT_TRUE(std::none_of(all.begin(), all.end(),
                           [](const std::string& note) { return note.rfind("ours: only", 0) == 0; }));
}

TEST_F(ComparisonTest, EveryMeasureIsInTheCsv) {
  writeCell("flown/a/calibrated/ours", "0.25", "0.5");
  EXPECT_NE(comparisonCsv(comparison()).find("flown,a,calibrated,ours,error_at_half_recall,0.25\n"),
            std::string::npos);
}

TEST_F(ComparisonTest, ThePageHoldsTablesCurvesAndImages) {
  writeCell("flown/a/calibrated/ours", "0.2", "0.8");
  writeText(folder_ / "cells/flown/a/calibrated/ours/pr.csv",
            "threshold,precision,recall\n255,1,0\n1,0.5,1\n");
  writeText(folder_ / "cells/flown/a/calibrated/ours/images/best-7.jpg", "jpeg");
  const std::string page = comparisonPage(comparison(), comparisonTables(comparison()));
  EXPECT_NE(page.find("0.200 / 0.800"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_NE(page.find("data:image/jpeg;base64,anBlZw=="), std::string::npos);
  EXPECT_EQ(page.find("src=\"/"), std::string::npos);
}

TEST_F(ComparisonTest, ErrorsInListsNameTheLine) {
  writeText(folder_ / "short.txt", "# comment\nflown a asl\n");
  EXPECT_NE(errorMessageOf([&] { readClipList(folder_ / "short.txt"); }).find("short.txt:2: has 3 fields"),
            std::string::npos);
  writeText(folder_ / "empty.txt", "# nothing\n");
  EXPECT_NE(errorMessageOf([&] { readMethodList(folder_ / "empty.txt"); }).find("lists nothing"),
            std::string::npos);
}

}  // namespace
}  // namespace redbee::test
