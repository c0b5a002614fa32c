// redbee export, mosaic and what else writes a file: their inputs stay as they are, and damage is reported.
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/export/export_mcap.hpp"
#include "processes/redbee/export/recorded_targets.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/targets_t.hpp"
#include "tests/support/configuration_file.hpp"
#include "tests/support/log_events.hpp"

namespace redbee::test {
namespace {

struct Outcome {
  int code;
  std::string errors;
};

Outcome run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "redbee");
  std::vector<char*> argv;
  argv.reserve(arguments.size());
  for (std::string& argument : arguments) argv.push_back(argument.data());
  testing::internal::CaptureStderr();
  const int code = runTool(static_cast<int>(argv.size()), argv.data());
  return {code, testing::internal::GetCapturedStderr()};
}

altimeter_t heightAt(int64_t utime) {
  altimeter_t message{};
  message.utime = utime;
  message.height = 40;
  message.sigma = 0.1;
  return message;
}

/// One target on WGS-84 in each of three frames.
void writeTargets(const fs::path& file) {
  LogWriter log(file);
  for (int k = 1; k <= 3; ++k) {
    targets_t message{};
    message.utime = 1'000'000 * k;
    message.has_global = 1;
    message.n = 1;
    message.targets.resize(1);
    message.targets[0].id = 1;
    message.targets[0].state = target_t::MOVING;
    message.targets[0].latitude = 47;
    message.targets[0].longitude = 8 + 1e-5 * k;
    message.targets[0].size[0] = message.targets[0].size[1] = 1;
    message.targets[0].position_covariance[0] = message.targets[0].position_covariance[3] = 1;
    message.targets[0].velocity_covariance[0] = message.targets[0].velocity_covariance[3] = 1;
    log.write("TARGETS", message);
  }
  log.close();
}

TEST(ExportCommand, NoFileThatIsReadIsOverwritten) {
  const ScratchFolder folder;
  writeTargets(folder / "f.lcm");
  writeText(folder / "base.yaml", kCamera);
  cv::Mat1b mask(480, 640, uint8_t{0});
  mask.rowRange(0, 40) = 255;
  cv::imwrite((folder / "mask.png").string(), mask);
  writeText(folder / "vehicle.yaml", "include: base.yaml\ncamera: {mask: mask.png}\n");
  writeText(folder / "rr" / "detections.csv", "utime,id\n");
  for (const char* kind : {"mcap", "geojson", "kml"}) {
    for (const char* input : {"f.lcm", "base.yaml", "vehicle.yaml", "mask.png", "rr/detections.csv"}) {
      const bool takes_results = std::string(kind) == "mcap";
      if (!takes_results && std::string(input) == "rr/detections.csv") continue;
      std::vector<std::string> arguments{"export",         kind,          "--log",
                                         folder / "f.lcm", "--config",    folder / "vehicle.yaml",
                                         "--out",          folder / input};
      if (takes_results) arguments.insert(arguments.end(), {"--results", folder / "rr"});
      const std::string before = readText(folder / input);
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.code, 2) << kind << " " << input;
      EXPECT_NE(outcome.errors.find("is also the input"), std::string::npos) << outcome.errors;
      EXPECT_EQ(readText(folder / input), before) << kind << " " << input;
    }
  }
}

TEST(WritingCommands, NoIncludedConfigurationIsOverwritten) {
  const ScratchFolder folder;
  writeTargets(folder / "f.lcm");
  writeText(folder / "base.yaml", kCamera);
  writeText(folder / "vehicle.yaml", "include: base.yaml\n");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"overlay", "--log", folder / "f.lcm", "--results", folder / "rr"},
        {"report", "--log", folder / "f.lcm", "--results", folder / "rr"},
        {"reference-extrinsics", "--flight", folder / "flight"}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--config", folder / "vehicle.yaml", "--out", folder / "base.yaml"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << command[0];
    EXPECT_NE(outcome.errors.find("is also the input"), std::string::npos) << outcome.errors;
    EXPECT_EQ(readText(folder / "base.yaml"), kCamera) << command[0];
  }
}

TEST(ExportCommand, ATimeThatNanosecondsCannotHoldIsDamage) {
  const ScratchFolder folder;
  LogWriter log(folder / "f.lcm");
  for (const int64_t utime : {int64_t{1'000'000}, int64_t{9'300'000'000'000'000}, int64_t{2'000'000}})
    log.write("ALTIMETER", heightAt(utime));
  log.close();
  McapExport options;
  options.log = folder / "f.lcm";
  options.out = folder / "f.mcap";
  const McapExported exported = exportMcap(options);
  EXPECT_EQ(exported.damaged, 1);
  EXPECT_EQ(exported.messages.at("/altimeter"), 2);
}

TEST(ExportCommand, OfALogThatIsCutShortThatIsSaid) {
  const ScratchFolder folder;
  writeTargets(folder / "f.lcm");
  fs::resize_file(folder / "f.lcm", fs::file_size(folder / "f.lcm") - 20);
  for (const char* kind : {"geojson", "kml"}) {
    const Outcome outcome = run({"export", kind, "--log", folder / "f.lcm", "--out", folder / kind});
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_NE(outcome.errors.find("f.lcm: byte "), std::string::npos) << outcome.errors;
  }
}

TEST(MosaicCommand, EveryIsAtLeastOne) {
  const Outcome outcome = run({"mosaic", "--every", "0"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_LT(outcome.errors.size(), 200U) << outcome.errors;
}

}  // namespace
}  // namespace redbee::test
