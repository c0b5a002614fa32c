// Tiles of a folder, by number alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "processes/serve/station.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

class Tiles : public testing::Test {
 protected:
  Tiles() {
    writeText(folder_ / "tiles/14/8580/5741.png", "the tile");
    writeText(folder_ / "tiles/13/x/1.png", "no tile");
    writeText(folder_ / "tiles/readme", "");
    writeText(folder_ / "secret.png", "secret");
  }
  WebResponse get(const std::string& path, const std::map<std::string, std::string>& query) {
    return station_.answer({"GET", path, query, {{"host", "localhost"}}});
  }
  int tile(const std::string& z, const std::string& x, const std::string& y) {
    return get("/api/tile", {{"z", z}, {"x", x}, {"y", y}}).status;
  }

  ScratchFolder folder_;
  Live live_;
  Archive archive_{Configuration(), {}};
  Station station_{Access(*listenAddressOf("127.0.0.1:1"), "", false), archive_, live_, supervisedStack()};
};

TEST_F(Tiles, AreThoseOfTheFolder) {
  EXPECT_EQ(get("/api/tiles", {}).body, "[]");
  EXPECT_EQ(tile("14", "8580", "5741"), 404) << "no folder was given";
  station_.showTiles(folder_ / "tiles");
  EXPECT_EQ(get("/api/tiles", {}).body, "[13,14]");
  const WebResponse found = get("/api/tile", {{"z", "14"}, {"x", "8580"}, {"y", "5741"}});
  EXPECT_EQ(found.status, 200);
  EXPECT_EQ(found.type, "image/png");
  EXPECT_EQ(readText(found.file), "the tile");
  EXPECT_EQ(found.file_bytes, 8U);
  EXPECT_EQ(tile("14", "8580", "5742"), 404);
}

TEST_F(Tiles, LeadNowhereElse) {
  station_.showTiles(folder_ / "tiles");
  for (const char* wrong : {"../secret", "", "-1", "1.0", "99999999999999999999", "16384"})
    EXPECT_EQ(tile("14", wrong, "5741"), 400) << wrong;
  EXPECT_EQ(tile("14", "8580", "16384"), 400);
  EXPECT_EQ(tile("63", "0", "0"), 400);
  EXPECT_EQ(tile("..", "8580", "5741"), 400);
}

}  // namespace
}  // namespace redbee::test
