// What the addresses answer: flights on disk, live frames; names from the browser lead nowhere else.
#include "processes/serve/station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "redbee/bus/image.hpp"
#include "redbee/files/log.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/image_codec/image_codec.hpp"
#include "redbee/image_codec/png.hpp"
#include "redbee/results/run_folder.hpp"
#include "redbee/targets_t.hpp"
#include "tests/support/camera.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {
using nlohmann::json;
using testing::HasSubstr;
constexpr int kFrames = 5;

int64_t utimeOf(int k) { return 1'000'000'000 + k * 40'000; }
cv::Mat1b imageOf(int k) { return cv::Mat1b(kHeight, kWidth, static_cast<uint8_t>(40 * k)); }

detections_t detectionsOf(int k) {
  detections_t m{};
  m.utime = utimeOf(k);
  m.status = foreground_t::GOOD;
  m.n = 1;
  m.detections.resize(1);
  m.detections[0] = {9, 10 + k, 20, 30, 40, 500, 0.5, 1};
  return m;
}
// What json may throw where it is moved ends the test. NOLINTNEXTLINE(bugprone-exception-escape)
struct Bundle {
  json head;
  cv::Mat image;
  cv::Mat mask;
};
Bundle parse(const std::string& bytes) {
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  const size_t length = size_t{data[0]} << 24 | data[1] << 16 | data[2] << 8 | data[3];
  Bundle bundle;
  bundle.head = json::parse(bytes.substr(4, length));
  const size_t image_bytes = bundle.head["image_bytes"];
  const size_t mask_bytes = bundle.head["mask_bytes"];
  EXPECT_EQ(bytes.size(), 4 + length + image_bytes + mask_bytes);
  const uint8_t* at = data + 4 + length;
  const auto decode = [](const uint8_t* from, size_t n) { return decodeGreyImage({from, from + n}); };
  bundle.image = decode(at, image_bytes);
  bundle.mask = decode(at + image_bytes, mask_bytes);
  return bundle;
}
class StationTest : public testing::Test {
 protected:
  StationTest() {
    configuration_.camera = intrinsics();
    fs::create_directories(folder_ / "flights");
    writeText(folder_ / "secret.lcm", "no flight");
  }
  void writeFlight(const std::string& name, bool with_detections) const {
    LogWriter log(folder_ / "flights" / name);
    for (int k = 0; k < kFrames; ++k) {
      log.write("CAMERA", rawGreyMessage(utimeOf(k), imageOf(k)));
      if (!with_detections) continue;
      foreground_t mask{};
      mask.utime = utimeOf(k);
      mask.utime_previous = utimeOf(k - 1);
      mask.width = kWidth;
      mask.height = kHeight;
      cv::Mat1b moving = cv::Mat1b::zeros(kHeight, kWidth);
      moving(20, 10 + k) = 255;
      mask.mask = encodeBilevelPng(moving);
      mask.mask_size = static_cast<int32_t>(mask.mask.size());
      mask.probability = encodePng(moving);
      mask.probability_size = static_cast<int32_t>(mask.probability.size());
      mask.unknown = encodeBilevelPng(moving);
      mask.unknown_size = static_cast<int32_t>(mask.unknown.size());
      log.write("FOREGROUND", mask);
      log.write("DETECTIONS", detectionsOf(k));
      targets_t targets{};
      targets.utime = utimeOf(k);
      targets.n = 1;
      targets.targets.resize(1);
      targets.targets[0].id = 9;
      targets.targets[0].position[0] = k;
      log.write("TARGETS", targets);
    }
    log.close();
  }
  WebResponse get(const std::string& path, const std::map<std::string, std::string>& query = {}) {
    return station().answer({"GET", path, query, {{"host", "localhost"}}});
  }
  WebResponse post(const std::string& path, const std::map<std::string, std::string>& query) {
    return station().answer({"POST", path, query, {{"host", "localhost"}, {"x-redbee", "1"}}});
  }
  Station& station() {
    if (!station_) {
      archive_.emplace(configuration_, std::vector<fs::path>{folder_ / "flights"});
      StackControl control{[] { return std::optional<bool>(true); },
                           [this](const std::string& action, const std::string& process) {
                             done_ += action + " " + process + ";";
                             return std::string();
                           }};
      station_.emplace(Access(*listenAddressOf("127.0.0.1:1"), "", true), *archive_, live_, control);
    }
    return *station_;
  }

  ScratchFolder folder_;
  Configuration configuration_;
  Live live_;
  std::optional<Archive> archive_;
  std::optional<Station> station_;
  std::string done_;
};

TEST_F(StationTest, ShowsAFlightWithItsOwnDetections) {
  writeFlight("a.lcm", true);
  const json list = json::parse(get("/api/flights").body);
  ASSERT_EQ(list["flights"].size(), 1U);
  EXPECT_EQ(list["flights"][0]["name"], "flights/a.lcm");
  const json flight = json::parse(get("/api/flight", {{"name", "flights/a.lcm"}}).body);
  EXPECT_EQ(flight["times"], json({0, 40000, 80000, 120000, 160000}));
  const auto response = get("/api/flight/frame", {{"name", "flights/a.lcm"}, {"k", "3"}});
  ASSERT_EQ(response.status, 200) << response.body;
  const Bundle bundle = parse(response.body);
  EXPECT_EQ(bundle.head["utime"], utimeOf(3));
  EXPECT_EQ(bundle.head["detections"][0]["id"], 9);
  EXPECT_EQ(bundle.head["detections"][0]["x"], 13);
  EXPECT_EQ(bundle.head["status"], "good");
  EXPECT_NEAR(bundle.image.at<uint8_t>(100, 100), 120, 2);
  EXPECT_EQ(bundle.head["map"]["targets_utime"], utimeOf(3));
  EXPECT_EQ(bundle.head["map"]["targets"][0]["id"], 9);
  EXPECT_EQ(bundle.head["map"]["targets"][0]["position"], json({3, 0}));
  EXPECT_EQ(bundle.mask.at<uint8_t>(20, 13), 255);
  EXPECT_EQ(cv::countNonZero(bundle.mask), 1);
}

TEST_F(StationTest, ShowsASplitFlightWithTheRunThatBelongsToIt) {
  writeFlight("b.lcm", false);
  fs::rename(folder_ / "flights/b.lcm", folder_ / "flights/b.lcm.0000");
  const auto run = [&](const std::string& name, int64_t offset) {
    const RunFolder results(folder_ / "flights" / name);
    results.prepare();
    auto homographies = results.createHomographies();
    auto detections = results.createDetections();
    for (int k = 0; k < kFrames; ++k) {
      homographies.write(utimeOf(k) + offset, {0, Eigen::Matrix3d::Identity(), {}, "fused"});
      detections.write(k, utimeOf(k) + offset, {9, {10 + k, 20, 30, 40}, 0, 0.5, true});
    }
    homographies.close();
    detections.close();
  };
  run("other", 1);  // of another flight
  run("own", 0);
  const json flight = json::parse(get("/api/flight", {{"name", "flights/b.lcm"}}).body);
  EXPECT_THAT(flight["run"].get<std::string>(), HasSubstr("/own"));
  const Bundle bundle = parse(get("/api/flight/frame", {{"name", "flights/b.lcm"}, {"k", "2"}}).body);
  EXPECT_EQ(bundle.head["detections"][0]["x"], 12);
  EXPECT_EQ(bundle.head["source"], "fused");
  EXPECT_EQ(bundle.head["trails"][0]["points"].size(), 3U);
}

TEST_F(StationTest, SaysWhereThereAreNoDetections) {
  writeFlight("c.lcm", false);
  const Bundle bundle = parse(get("/api/flight/frame", {{"name", "flights/c.lcm"}, {"k", "0"}}).body);
  EXPECT_THAT(bundle.head["note"].get<std::string>(), HasSubstr("redbee detect makes one"));
  EXPECT_FALSE(bundle.head.contains("detections"));
}

TEST_F(StationTest, NamesLeadNowhereElse) {
  writeFlight("a.lcm", true);
  for (const char* name :
       {"flights/../secret.lcm", "../secret.lcm", "secret.lcm", "/etc/passwd", "", "flights"}) {
    EXPECT_EQ(get("/api/flight", {{"name", name}}).status, 404) << name;
    EXPECT_EQ(get("/report", {{"name", name}}).status, 404) << name;
  }
  EXPECT_EQ(get("/../secret.lcm").status, 404);
  for (const char* k : {"", "-1", "1x", "99999999999999999999"})
    EXPECT_EQ(get("/api/flight/frame", {{"name", "flights/a.lcm"}, {"k", k}}).status, 400) << k;
  EXPECT_EQ(get("/api/flight/frame", {{"name", "flights/a.lcm"}, {"k", "5"}}).status, 404);
}

TEST_F(StationTest, SaysInOneLineWhyAFlightCannotBeShown) {
  writeText(folder_ / "flights/broken.lcm", "this is no log");
  const auto response = get("/api/flight", {{"name", "flights/broken.lcm"}});
  EXPECT_EQ(response.status, 422);
  EXPECT_THAT(response.body, HasSubstr("broken.lcm"));
}

TEST_F(StationTest, WritesGoToTheSupervisorByNamesOfTheTable) {
  EXPECT_EQ(post("/api/record", {{"on", "1"}}).status, 200);
  EXPECT_EQ(post("/api/restart", {{"process", "camera"}}).status, 200);
  EXPECT_EQ(post("/api/restart", {{"process", "camera</string>"}}).status, 404);
  EXPECT_EQ(done_, "start record;restart camera;");
}

TEST_F(StationTest, ARecordingEndsOnlyWhereTheRequestSaysSo) {
  EXPECT_EQ(post("/api/record", {}).status, 400);
  for (const char* on : {"", "2", "true", "01", "1 "})
    EXPECT_EQ(post("/api/record", {{"on", on}}).status, 400) << on;
  EXPECT_EQ(done_, "");
  EXPECT_EQ(post("/api/record", {{"on", "0"}}).status, 200);
  EXPECT_EQ(done_, "stop record;");
}

TEST_F(StationTest, LiveGivesTheNewestFrameOnly) {
  EXPECT_EQ(get("/api/frame", {{"after", "0"}}).status, 204);
  for (int k = 0; k < 3; ++k) {
    FrameView view;
    view.utime = utimeOf(k);
    view.image = std::make_shared<const image_t>(rawGreyMessage(utimeOf(k), imageOf(k)));
    live_.setFrame(std::move(view));
  }
  EXPECT_EQ(parse(get("/api/frame", {{"after", "0"}}).body).head["utime"], utimeOf(2));
  EXPECT_EQ(get("/api/frame", {{"after", "3"}}).status, 204);
  EXPECT_EQ(get("/api/frame", {{"after", "400"}}).status, 200) << "a number of the server before a restart";
  const auto update = live_.wait({}, std::chrono::milliseconds(0));
  ASSERT_TRUE(update.frame);
  EXPECT_EQ(update.frame->sequence(), 3);
}

TEST_F(StationTest, TheMapComesWithoutFrames) {
  live_.setMap("first");
  live_.setMap("second");
  const auto update = live_.wait({}, std::chrono::milliseconds(0));
  EXPECT_FALSE(update.frame);
  EXPECT_EQ(update.map, "second");
  EXPECT_EQ(live_.wait({0, 0, update.map_sequence}, std::chrono::milliseconds(0)).map, "");
}

TEST_F(StationTest, ThePageNeedsNoOtherAddress) {
  const auto page = get("/");
  EXPECT_THAT(page.body, HasSubstr("main.js"));
  for (const char* file :
       {"/", "/main.js", "/style.css", "/picture.js", "/map.js", "/targets.js", "/wire.js"}) {
    const auto response = get(file);
    EXPECT_EQ(response.status, 200) << file;
    EXPECT_EQ(response.body.find("https://"), std::string::npos) << file;
    EXPECT_EQ(response.body.find("src=\"http"), std::string::npos) << file;
  }
}

}  // namespace
}  // namespace redbee::test
