// What of the folders is shown: each flight once, its parts in order, nothing from elsewhere.
#include "processes/serve/archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "redbee/files/user_error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class ArchiveTest : public testing::Test {
 protected:
  Archive archiveOf(const std::vector<std::string>& folders) const {
    std::vector<fs::path> paths;
    for (const std::string& folder : folders) paths.push_back(root_ / folder);
    return {Configuration(), paths};
  }
  static std::vector<std::string> namesOf(const std::vector<Archive::Entry>& entries) {
    std::vector<std::string> names;
    for (const auto& entry : entries) names.push_back(entry.name);
    return names;
  }

  ScratchFolder folder_;
  fs::path root_ = fs::canonical(folder_.path());
};

TEST_F(ArchiveTest, FoldersOfTheSameNameKeepTheirFlightsApart) {
  writeText(root_ / "x/flights/a.lcm", "1");
  writeText(root_ / "y/flights/a.lcm", "22");
  writeText(root_ / "y/flights/b.lcm", "22");
  const auto flights = archiveOf({"x/flights", "y/flights"}).flights();
  EXPECT_THAT(namesOf(flights),
              UnorderedElementsAre(root_ / "x/flights/a.lcm", root_ / "y/flights/a.lcm", "flights/b.lcm"));
  for (const auto& flight : flights) EXPECT_EQ(flight.files.size(), 1U) << flight.name;
}

TEST_F(ArchiveTest, AFolderGivenTwiceIsShownOnce) {
  writeText(root_ / "flights/day/a.lcm", "1");
  writeText(root_ / "flights/day/report.html", "1");
  fs::create_directory_symlink(root_ / "flights", root_ / "link");
  const Archive archive = archiveOf({"flights", "flights/", "link", "flights/../flights", "flights/day"});
  const auto flights = archive.flights();
  ASSERT_THAT(namesOf(flights), ElementsAre("flights/day/a.lcm"));
  EXPECT_THAT(flights[0].files, ElementsAre(root_ / "flights/day/a.lcm"));
  EXPECT_EQ(flights[0].bytes, 1);
  EXPECT_THAT(namesOf(archive.reports()), ElementsAre("flights/day/report.html"));
}

TEST_F(ArchiveTest, PartsAreInTheOrderOfTheirNumbers) {
  std::vector<fs::path> expected;
  for (int i = 0; i <= 12; ++i) {
    expected.push_back(root_ / ("flights/s.lcm." + std::to_string(i)));
    writeText(expected.back(), "1");
  }
  const auto flights = archiveOf({"flights"}).flights();
  ASSERT_THAT(namesOf(flights), ElementsAre("flights/s.lcm"));
  EXPECT_EQ(flights[0].files, expected);
}

TEST_F(ArchiveTest, ANameThatIsNoUtf8IsShownAndOpened) {
  writeText(root_ / "flights/fl\xff.lcm", "no log");
  writeText(root_ / "flights/r\xe9sum\xe9.html", "<p>");
  Archive archive = archiveOf({"flights"});
  ASSERT_THAT(namesOf(archive.flights()), ElementsAre("flights/fl\\xff.lcm"));
  EXPECT_THROW(archive.open("flights/fl\\xff.lcm", true), UserError) << "it is found, and is no log";
  EXPECT_TRUE(archive.report("flights/r\\xe9sum\\xe9.html"));
}

TEST_F(ArchiveTest, AFlightThatCouldNotBeReadIsReadAnew) {
  writeText(root_ / "flights/a.lcm", "no log");
  Archive archive = archiveOf({"flights"});
  for (int i = 0; i < 2; ++i) EXPECT_THROW(archive.open("flights/a.lcm", true), UserError);
  EXPECT_EQ(archive.open("flights/b.lcm", true), nullptr);
}

TEST_F(ArchiveTest, LinksLeadNowhereElse) {
  writeText(root_ / "elsewhere/secret.lcm", "1");
  writeText(root_ / "elsewhere/secret.html", "1");
  fs::create_directories(root_ / "flights");
  fs::create_symlink(root_ / "elsewhere/secret.lcm", root_ / "flights/a.lcm");
  fs::create_symlink(root_ / "elsewhere/secret.html", root_ / "flights/a.html");
  fs::create_directory_symlink(root_ / "elsewhere", root_ / "flights/folder");
  const Archive archive = archiveOf({"flights"});
  EXPECT_THAT(namesOf(archive.flights()), IsEmpty());
  EXPECT_THAT(namesOf(archive.reports()), IsEmpty());
  EXPECT_FALSE(archive.report("flights/a.html"));
}

}  // namespace
}  // namespace redbee::test
