// redbee log: what it says of a log, and what it makes of a damaged one.
#include <gtest/gtest.h>

#include "processes/redbee/logs/log_repair.hpp"
#include "processes/redbee/logs/log_survey.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/image_t.hpp"
#include "redbee/ins_t.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_flight.hpp"

namespace redbee::test {
namespace {

constexpr int64_t kStart = 1'600'000'000'000'000;

/// Two seconds: images at 10 Hz with one left out, an IMU at 100 Hz.
void writeFlight(const fs::path& file) {
  LogWriter log(file);
  for (int k = 0; k <= 200; ++k) {
    const int64_t utime = kStart + 10'000 * k;
    ins_t sample{};
    sample.utime = utime;
    log.write("IMU", sample);
    if (k % 10 == 0 && k != 100) log.write("CAMERA", rawGreyMessage(utime, cv::Mat1b(48, 64, uint8_t{5})));
  }
  log.close();
}

TEST(LogCommand, InfoListsChannelsTypesRatesAndGaps) {
  const ScratchFolder folder;
  writeFlight(folder / "f.lcm");
  const LogSurvey survey = surveyLog(folder / "f.lcm");
  ASSERT_EQ(survey.channels.size(), 2u);
  const ChannelSurvey& camera = survey.channels.at("CAMERA");
  EXPECT_EQ(camera.type, "image_t 64x48 GRAY");
  EXPECT_EQ(camera.messages, 20);
  EXPECT_DOUBLE_EQ(camera.rate(), 9.5);
  EXPECT_EQ(camera.longest_gap_us, 200'000);
  EXPECT_EQ(survey.channels.at("IMU").type, "ins_t");
  EXPECT_DOUBLE_EQ(survey.channels.at("IMU").rate(), 100);
  const std::string text = asText(survey, "f.lcm");
  EXPECT_NE(text.find("damage:   none\n"), std::string::npos) << text;
  EXPECT_NE(text.find("duration: 2.000 s\n"), std::string::npos) << text;
  EXPECT_NE(text.find("2020-09-13 12:26:40 UTC"), std::string::npos) << text;
}

TEST(LogCommand, ForeignTypesAndBrokenMessagesAreCounted) {
  const ScratchFolder folder;
  LogWriter log(folder / "f.lcm");
  log.write(1, "OTHER", {1, 2, 3, 4, 5, 6, 7, 8, 9});
  ins_t sample{};
  std::vector<uint8_t> data(static_cast<size_t>(sample.getEncodedSize()));
  sample.encode(data.data(), 0, static_cast<int>(data.size()));
  log.write(2, "IMU", data);
  log.write(3, "CAMERA", data);
  log.write("CAMERA", rawGreyMessage(4, cv::Mat1b(4, 4)));
  data.pop_back();
  log.write(5, "IMU", data);
  log.close();
  const LogSurvey survey = surveyLog(folder / "f.lcm");
  EXPECT_EQ(survey.channels.at("OTHER").type, "0x0102030405060708");
  EXPECT_EQ(survey.channels.at("IMU").damaged, 1);
  EXPECT_EQ(survey.channels.at("CAMERA").type, "ins_t");
  EXPECT_EQ(survey.channels.at("CAMERA").other_types, 1);
}

TEST(LogCommand, RepairKeepsWhatIsWhole) {
  const ScratchFolder folder;
  writeFlight(folder / "whole.lcm");
  std::string bytes = readText(folder / "whole.lcm");
  for (size_t at = 20'000; at < 20'040; ++at) bytes[at] = 0x55;
  bytes.resize(bytes.size() - 10);
  writeText(folder / "f.lcm", bytes);
  EXPECT_NE(asText(surveyLog(folder / "f.lcm"), "f.lcm").find("the end is cut short"), std::string::npos);
  const LogRepair repair = repairLog({folder / "f.lcm"}, folder / "repaired.lcm");
  const auto whole = readEvents(folder / "whole.lcm");
  const auto repaired = readEvents(folder / "repaired.lcm");  // fails on damage
  EXPECT_EQ(repair.damage.size(), 1u);
  EXPECT_EQ(static_cast<size_t>(repair.messages), repaired.size());
  EXPECT_GE(repaired.size(), whole.size() - 4);
  EXPECT_LT(repaired.size(), whole.size());
  EXPECT_NE(
      errorMessageOf([&] { repairLog({folder / "f.lcm"}, folder / "f.lcm"); }).find("is also the input"),
      std::string::npos);
}

TEST(LogCommand, PartsAreJoinedInTheOrderOfTheirNumbers) {
  const ScratchFolder folder;
  std::vector<fs::path> parts;
  for (int k = 0; k < 120; ++k) {
    parts.push_back(folder / ("f.lcm." + std::string(k < 10 ? "0" : "") + std::to_string(k)));
    LogWriter part(parts.back());
    part.write(k, "X", {1});
    part.close();
  }
  std::sort(parts.begin(), parts.end());  // as a shell lists them
  repairLog(parts, folder / "f.lcm");
  const auto events = readEvents(folder / "f.lcm");
  ASSERT_EQ(events.size(), 120u);
  for (int k = 0; k < 120; ++k) {
    EXPECT_EQ(events[static_cast<size_t>(k)].utime, k);
    EXPECT_EQ(events[static_cast<size_t>(k)].number, k);
  }
}

TEST(LogCommand, PartsThatAreMissingOrThereTwiceAreReported) {
  const ScratchFolder folder;
  std::vector<fs::path> parts;
  for (const char* number : {"0002", "0003", "0007", "0009", "0010"}) {
    parts.push_back(folder / (std::string("f.lcm.") + number));
    LogWriter part(parts.back());
    part.write(1, "X", {1});
    part.close();
  }
  const LogRepair repair = repairLog(parts, folder / "f.lcm");
  EXPECT_EQ(repair.messages, 5);
  EXPECT_EQ(repair.missing, "parts 4 to 6 and 8 are not among the files: their messages are left out");
  parts.resize(2);
  EXPECT_EQ(repairLog(parts, folder / "g.lcm").missing, "");
  parts.push_back(folder / "." / "f.lcm.0003");
  EXPECT_NE(errorMessageOf([&] { repairLog(parts, folder / "h.lcm"); }).find("f.lcm.0003: is given twice"),
            std::string::npos);
}

/// As redbee record and lcm-logger leave it.
TEST(LogCommand, ALogThatIsThereInPartsIsNotJustMissing) {
  const ScratchFolder folder;
  EXPECT_EQ(errorMessageOf([&] { surveyLog(folder / "f.lcm"); }),
            (folder / "f.lcm").string() + ": no such file");
  writeFlight(folder / "f.lcm.0000");
  EXPECT_NE(errorMessageOf([&] {
              surveyLog(folder / "f.lcm");
            }).find("f.lcm: no such file, but its parts: redbee log repair "),
            std::string::npos);
}

TEST(LogCommand, RecordedCase) {
  const auto log = sharedCase("yuyv_1frame.lcm");
  if (!log) GTEST_SKIP() << "the cases are not here (REDBEE_SHARED)";
  EXPECT_EQ(surveyLog(*log).channels.at("CAMERA").type, "image_t 320x240 YUYV");
}

}  // namespace
}  // namespace redbee::test
