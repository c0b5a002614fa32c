#include "redbee/configuration/configuration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <set>

namespace redbee {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

const fs::path kConfigFolder = fs::path(REDBEE_SOURCE_DIR) / "config";
constexpr const char* kCamera = "camera: {width: 640, height: 480, fx: 500, fy: 500, cx: 319.5, cy: 239.5}\n";

/// A folder of its own for every test.
class ConfigurationTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("redbee-configuration-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  Configuration load(const std::string& text) const { return loadConfiguration(write("vehicle.yaml", text)); }
  /// The complaint about vehicle.yaml, without the folder.
  std::string complaint(const std::string& text) const {
    try {
      load(text);
    } catch (const ConfigurationError& error) {
      const std::string what = error.what();
      EXPECT_EQ(std::count(what.begin(), what.end(), '\n'), 0) << what;
      EXPECT_THAT(what, StartsWith((folder_ / "").string()));
      return what.substr((folder_ / "").string().size());
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(ConfigurationTest, cameraAloneIsEnough) {
  const auto configuration = load(kCamera);
  EXPECT_EQ(configuration.camera.width, 640);
  EXPECT_EQ(configuration.camera.cx, 319.5);
  EXPECT_EQ(configuration.channels.camera, "CAMERA");
  EXPECT_EQ(configuration.fusion.noise, FusionNoise::kPropagated);
}

TEST_F(ConfigurationTest, matricesAreRowMajor) {
  const auto configuration = load(
      "camera: {width: 640, height: 480, fx: 1, fy: 1, cx: 0, cy: 0, "
      "R_CI: [0, -1, 0, 0, 0, -1, 1, 0, 0], p_IC: [1, 2, 3]}\n");
  const auto& extrinsics = configuration.inertial.extrinsics;
  EXPECT_EQ(extrinsics.R_CI * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ())
      << "forward is the optical axis";
  EXPECT_EQ(extrinsics.R_CI * Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY()) << "up is against y";
  EXPECT_EQ(extrinsics.p_IC, Eigen::Vector3d(1, 2, 3));
}

TEST_F(ConfigurationTest, distortionMayLeaveOutK3) {
  const std::string camera = "camera: {width: 640, height: 480, fx: 1, fy: 1, cx: 0, cy: 0, distortion: ";
  EXPECT_EQ(load(camera + "[1, 2, 3, 4]}").camera.distortion, (std::array<double, 5>{1, 2, 3, 4, 0}));
  EXPECT_EQ(load(camera + "[1, 2, 3, 4, 5]}").camera.distortion[4], 5);
}

struct Fault {
  std::string text;   ///< follows the camera, so that its first line is the file's second
  std::string place;  ///< line and key
  std::string what;
};

TEST_F(ConfigurationTest, faultsAreNamedWithFileLineAndKey) {
  const std::vector<Fault> faults{
      {"colour: red\n", "2: colour: ", "unknown key"},
      {"visual:\n  trackr: {}\n", "3: visual.trackr: ", "unknown key"},
      {"visual:\n  tracker:\n    grid_px: wide\n", "4: visual.tracker.grid_px: ", "whole number"},
      {"visual:\n  tracker:\n    grid_px: 16.5\n", "4: visual.tracker.grid_px: ", "whole number"},
      {"visual:\n  tracker:\n    grid_px: 99999999999\n", "4: visual.tracker.grid_px: ", "whole number"},
      {"visual:\n  tracker:\n    grid_px: 0\n", "4: visual.tracker.grid_px: ", "above 0"},
      {"visual: {tracker: {window_px: 12}}\n", "2: visual.tracker.window_px: ", "odd"},
      {"visual: {ransac: {seed: -1}}\n", "2: visual.ransac.seed: ", "whole number"},
      {"visual: {ransac: {confidence: 1}}\n", "2: visual.ransac.confidence: ", "between 0 and 1"},
      {"visual: 5\n", "2: visual: ", "section"},
      {"imu:\n\n  gyro_noise_density: -1\n", "4: imu.gyro_noise_density: ", "above 0"},
      {"imu: {gyro_random_walk: -1}\n", "2: imu.gyro_random_walk: ", "negative"},
      {"imu: {gyro_noise_density: .nan}\n", "2: imu.gyro_noise_density: ", "finite"},
      {"imu: {gyro_noise_density: .inf}\n", "2: imu.gyro_noise_density: ", "finite"},
      {"imu: {gyro_noise_density: [1]}\n", "2: imu.gyro_noise_density: ", "a number"},
      {"imu: {gyro_noise_density: }\n", "2: imu.gyro_noise_density: ", "a number"},
      {"imu: {present: maybe}\n", "2: imu.present: ", "true or false"},
      {"plane: {height_m: 0}\n", "2: plane.height_m: ", "above 0"},
      {"plane: {height_sigma_m: 0}\n", "2: plane.height_sigma_m: ", "above 0"},
      {"fusion: {noise: loud}\n", "2: fusion.noise: ", "propagated or paper"},
      {"fusion: {paper_Q: [1, 1, 1]}\n", "2: fusion.paper_Q: ", "8 numbers, has 3"},
      {"fusion: {paper_Q: [1, 1, 1, 1, 1, 1, 1, 0]}\n", "2: fusion.paper_Q: ", "above 0"},
      {"segmentation: {alpha: 1.5}\n", "2: segmentation.alpha: ", "from 0 to 1"},
      {"channels: {imu: ''}\n", "2: channels.imu: ", "1 to 63"},
      {"channels: {imu: CAMERA}\n", "2: channels.imu: ", "used twice"},
      {"channels: {camera: IMU}\n", "2: channels.camera: ", "used twice"},
      {"waits: {max_backlog: 0}\n", "2: waits.max_backlog: ", "above 0"},
      {"waits: {fusion_s: 0.25}\n", "2: waits.fusion_s: ", "must be longer than waits.visual_s (0.25 s)"},
      {"waits:\n  visual_s: 0.4\n", "3: waits.visual_s: ", "waits.fusion_s (0.3 s) must be longer"},
      {"waits: {fusion_s: 0.5}\n", "2: waits.fusion_s: ", "waits.segmentation_s (0.45 s) must be longer"},
      {"vehicle: a\nvehicle: b\n", "3: vehicle: ", "second time"},
      {"preset: fancy\n", "2: preset: ", "default or paper"},
      {"include: nowhere.yaml\n", "2: include: ", "no file"},
      {"include: {a: b}\n", "2: include: ", "file name"},
      {"vehicle: [\n", "3: syntax: ", ""},
      {"\"two\\nlines\": 1\n", "2: two lines: ", "unknown key"},
  };
  for (const auto& fault : faults) {
    const std::string said = complaint(kCamera + fault.text);
    EXPECT_THAT(said, StartsWith("vehicle.yaml:" + fault.place)) << fault.text;
    EXPECT_THAT(said, HasSubstr(fault.what)) << fault.text;
  }
}

TEST_F(ConfigurationTest, cameraThatCannotBeIsRefused) {
  const auto camera = [](const std::string& change) {
    return "camera:\n  width: 640\n  height: 480\n  fx: 500\n  fy: 500\n  cx: 319.5\n  " + change + "\n";
  };
  EXPECT_THAT(complaint(camera("")), StartsWith("vehicle.yaml:1: camera.cy: is missing"));
  EXPECT_THAT(complaint(camera("cy: 1\n  R_CI: [1, 0, 0, 0, 1, 0, 0, 0, -1]")),
              StartsWith("vehicle.yaml:8: camera.R_CI: is no rotation"));
  EXPECT_THAT(complaint(camera("cy: 1\n  R_CI: [1, 0, 0, 0, 1.01, 0, 0, 0, 1]")),
              HasSubstr("is no rotation"));
  EXPECT_THAT(complaint(camera("cy: 1\n  fx: 2")),
              StartsWith("vehicle.yaml:8: camera.fx: stands here for the second time"));
  EXPECT_THAT(complaint("camera: {width: 0}\n"), StartsWith("vehicle.yaml:1: camera.width: "));
  EXPECT_THAT(complaint("camera: {fx: -500}\n"), StartsWith("vehicle.yaml:1: camera.fx: must be above 0"));
  EXPECT_THAT(complaint("camera: {distortion: [1, 2, 3]}\n"), HasSubstr("has 3"));
}

TEST_F(ConfigurationTest, fileThatIsNotThereIsNamed) {
  EXPECT_THROW(loadConfiguration(folder_ / "nothing.yaml"), ConfigurationError);
  EXPECT_THAT(complaint(""), HasSubstr("holds no keys"));
  EXPECT_THAT(complaint("just words"), HasSubstr("holds no keys"));
}

TEST_F(ConfigurationTest, includingFileWinsAndCalibrationIsIncludedUnchanged) {
  write("base.yaml", std::string(kCamera) + "vehicle: base\nplane: {height_m: 7}\n");
  write("calibration.yaml",
        "camera: {R_CI: [0, -1, 0, 0, 0, -1, 1, 0, 0], p_IC: [0.1, 0, 0], timeshift_s: 0.004}\n"
        "plane: {height_m: 9, height_sigma_m: 0.2}\nimu: {gyro_noise_density: 0.001}\n");
  const auto configuration = load("include: [base.yaml, calibration.yaml]\nvehicle: mine\n");
  EXPECT_EQ(configuration.vehicle, "mine");
  EXPECT_EQ(configuration.camera.width, 640);
  EXPECT_EQ(configuration.inertial.extrinsics.timeshift_s, 0.004);
  EXPECT_EQ(configuration.inertial.extrinsics.start_height_m, 9) << "the later include wins";
  EXPECT_EQ(configuration.inertial.noise.gyro_noise_density, 0.001);
}

TEST_F(ConfigurationTest, faultInAnIncludedFileNamesThatFile) {
  write("other.yaml", "\nwrong: 1\n");
  EXPECT_THAT(complaint(std::string("include: other.yaml\n") + kCamera), StartsWith("other.yaml:2: wrong: "));
}

TEST_F(ConfigurationTest, filesThatIncludeEachOtherAreRefused) {
  write("other.yaml", "vehicle: a\ninclude: vehicle.yaml\n");
  EXPECT_THAT(complaint(std::string("include: other.yaml\n") + kCamera),
              StartsWith("other.yaml:2: include: "));
  EXPECT_THAT(complaint("include: vehicle.yaml\n"), StartsWith("vehicle.yaml:1: include: "));
}

TEST_F(ConfigurationTest, paperPresetIsThePapersOwn) {
  const auto paper = load(std::string(kCamera) + "preset: paper\n");
  EXPECT_EQ(paper.fusion.noise, FusionNoise::kPaper);
  EXPECT_EQ(paper.fusion.paper_Q[2], 1.0);
  EXPECT_EQ(paper.fusion.paper_P0[2], 1e-4);
  EXPECT_EQ(paper.segmentation.method, SegmentationMethod::kTwoPlanes);
  EXPECT_EQ(paper.segmentation.gamma, 0.6);
  EXPECT_EQ(configurationHash(load(std::string(kCamera) + "preset: default\n")),
            configurationHash(load(kCamera)));
}

TEST_F(ConfigurationTest, presetWinsOverIncludesAndLosesToItsOwnFile) {
  write("base.yaml", std::string(kCamera) + "fusion: {noise: propagated}\nsegmentation: {alpha: 0.9}\n");
  const auto configuration = load("include: base.yaml\npreset: paper\nsegmentation: {beta: 0.7}\n");
  EXPECT_EQ(configuration.fusion.noise, FusionNoise::kPaper);
  EXPECT_EQ(configuration.segmentation.alpha, 0.4);
  EXPECT_EQ(configuration.segmentation.beta, 0.7);
}

TEST_F(ConfigurationTest, emittedYamlLoadsBackToTheSameHash) {
  Configuration configuration = loadConfiguration(kConfigFolder / "euroc_mav.yaml");
  configuration.vehicle = "quote \" colon: hash # back\\slash";
  configuration.inertial.extrinsics.timeshift_s = 0.1 + 0.2;
  configuration.visual.ransac.seed = 4294967295U;
  const auto again = load(emitYaml(configuration));
  EXPECT_EQ(again.vehicle, configuration.vehicle);
  EXPECT_EQ(emitYaml(again), emitYaml(configuration));
  EXPECT_EQ(configurationHash(again), configurationHash(configuration));
}

TEST(Configuration, EmitsSelectedKeysOnly) {
  Configuration configuration;
  configuration.inertial.extrinsics.start_height_m = 7;
  EXPECT_EQ(emitYaml(configuration, {"plane.height_m", "camera.timeshift_s"}),
            "camera:\n  timeshift_s: 0\nplane:\n  height_m: 7\n");
  EXPECT_EQ(emitYaml(configuration, {}), "");
  EXPECT_THROW(emitYaml(configuration, {"plane"}), std::invalid_argument);
}

TEST_F(ConfigurationTest, hashDependsOnContentAlone) {
  const auto plain = configurationHash(load(kCamera));
  EXPECT_EQ(plain.size(), 16U);
  EXPECT_EQ(configurationHash(load("# a comment\ncamera:\n  cy: 239.50\n  cx: 319.5\n  fy: 5e2\n  fx: 500.0\n"
                                   "  height: 480\n  width: 640\nwaits: {max_backlog: 14}\n")),
            plain);
  EXPECT_NE(configurationHash(load(std::string(kCamera) + "waits: {max_backlog: 9}\n")), plain);
}

/// Keys that a file states itself, read without the loader: by the indentation of its lines.
std::set<std::string> keysStatedIn(const fs::path& file) {
  std::set<std::string> keys;
  std::vector<std::string> open;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const size_t indent = line.find_first_not_of(' ');
    const size_t colon = line.find(':');
    if (indent == std::string::npos || line[indent] == '#' || colon == std::string::npos) continue;
    if (line.find('#') < colon) continue;
    open.resize(indent / 2);
    open.push_back(line.substr(indent, colon - indent));
    const size_t value = line.find_first_not_of(' ', colon + 1);
    if (value == std::string::npos || line[value] == '#') continue;
    std::string key;
    for (const auto& part : open) key += (key.empty() ? "" : ".") + part;
    keys.insert(key);
  }
  return keys;
}

TEST(ReferenceFile, statesEveryKeyAndNoOther) {
  const auto known = configurationKeys();
  EXPECT_EQ(keysStatedIn(kConfigFolder / "redbee.yaml"), std::set<std::string>(known.begin(), known.end()));
}

/// A line of emitted YAML that differs is a tunable whose value in the reference file is not the code's.
TEST(ReferenceFile, tunablesHaveTheCodesDefaults) {
  Configuration expected;
  const auto reference = loadConfiguration(kConfigFolder / "redbee.yaml");
  // What describes the vehicle is no tunable.
  expected.vehicle = reference.vehicle;
  expected.camera = reference.camera;
  expected.inertial.extrinsics.R_CI = reference.inertial.extrinsics.R_CI;
  expected.inertial.noise = reference.inertial.noise;
  EXPECT_EQ(emitYaml(reference), emitYaml(expected));
}

TEST(ConfigurationFiles, allOfThemLoad) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(kConfigFolder)) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW(loadConfiguration(entry.path())) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 4);
}

TEST(ConfigurationFiles, eurocExtrinsicsAreThePublishedOnes) {
  const auto euroc = loadConfiguration(kConfigFolder / "euroc_mav.yaml");
  // The camera's optical axis in body coordinates is the third column of the published T_BS.
  const Eigen::Vector3d axis = euroc.inertial.extrinsics.R_CI.transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(axis.x(), 0.00414029679422, 1e-12);
  EXPECT_NEAR(axis.y(), 0.025715529948, 1e-12);
}

}  // namespace
}  // namespace redbee
