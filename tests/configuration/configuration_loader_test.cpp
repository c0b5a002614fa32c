// Faults of a vehicle's file are named with their place; files include each other.
#include "tests/support/configuration_file.hpp"

namespace redbee::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class ConfigurationLoader : public ConfigurationFile {};

struct Fault {
  std::string text;   ///< follows the camera, so that its first line is the file's second
  std::string place;  ///< line and key
  std::string what;
};

TEST_F(ConfigurationLoader, FaultsAreReportedWithFileLineAndKey) {
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
      {"detection: {refinement: {alpha: 1.5}}\n", "2: detection.refinement.alpha: ", "from 0 to 1"},
      {"detection: {method: fancy}\n", "2: detection.method: ", "must be one of aurora, "},
      {"detection:\n  objects: {threshold: 0.3}\n",
       "3: detection.objects.threshold: ", "weak_threshold (0.4) must not exceed"},
      {"segmentation:\n  threshold: 0.5\n",
       "3: segmentation.threshold: ", "was renamed to detection.objects.threshold"},
      {"segmentation: {sample_grid_px: 16}\n",
       "2: segmentation.sample_grid_px: ", "was renamed to visual.tracker.grid_px"},
      {"geolocation: {R_CM: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n",
       "2: geolocation.R_CM: ", "was renamed to camera.R_CI"},
      {"channels: {kept_state: A}\n", "2: channels.kept_state: ", "was renamed to channels.warm_start"},
      {"segmentation: {nonsense: 1}\n", "2: segmentation.nonsense: ", "unknown key"},
      {"channels: {imu: ''}\n", "2: channels.imu: ", "1 to 63"},
      {"channels: {imu: CAMERA}\n", "2: channels.imu: ", "used twice"},
      {"channels: {camera: IMU}\n", "2: channels.camera: ", "used twice"},
      {"waits: {visual_s: -1}\n", "2: waits.visual_s: ", "negative"},
      {"waits: {fusion_s: 0.25}\n", "2: waits.fusion_s: ", "must be longer than waits.visual_s (0.25 s)"},
      {"waits:\n  visual_s: 0.4\n", "3: waits.visual_s: ", "waits.fusion_s (0.3 s) must be longer"},
      {"waits: {fusion_s: 0.5}\n", "2: waits.fusion_s: ", "waits.segmentation_s (0.45 s) must be longer"},
      {"vehicle: a\nvehicle: b\n", "3: vehicle: ", "second time"},
      {"preset: fancy\n", "2: preset: ", "one of default, paper, vision_only"},
      {"include: nowhere.yaml\n", "2: include: ", "no such file"},
      {"include: {a: b}\n", "2: include: ", "file name"},
      {"vehicle: [\n", "3: syntax: ", ""},
      {"\"two\\nlines\": 1\n", "2: two lines: ", "unknown key"},
  };
  for (const auto& fault : faults) {
    const std::string answer = errorMessage(kCamera + fault.text);
    EXPECT_THAT(answer, StartsWith("vehicle.yaml:" + fault.place)) << fault.text;
    EXPECT_THAT(answer, HasSubstr(fault.what)) << fault.text;
  }
}

TEST_F(ConfigurationLoader, AnImpossibleCameraIsRefused) {
  const auto camera = [](const std::string& change) {
    return "camera:\n  width: 640\n  height: 480\n  fx: 500\n  fy: 500\n  cx: 319.5\n  " + change + "\n";
  };
  EXPECT_THAT(errorMessage(camera("")), StartsWith("vehicle.yaml:1: camera.cy: is missing"));
  EXPECT_THAT(errorMessage(camera("cy: 1\n  R_CI: [1, 0, 0, 0, 1, 0, 0, 0, -1]")),
              StartsWith("vehicle.yaml:8: camera.R_CI: is no rotation"));
  EXPECT_THAT(errorMessage(camera("cy: 1\n  R_CI: [1, 0, 0, 0, 1.01, 0, 0, 0, 1]")),
              HasSubstr("is no rotation"));
  EXPECT_THAT(errorMessage(camera("cy: 1\n  fx: 2")),
              StartsWith("vehicle.yaml:8: camera.fx: stands here for the second time"));
  EXPECT_THAT(errorMessage("camera: {width: 0}\n"), StartsWith("vehicle.yaml:1: camera.width: "));
  EXPECT_THAT(errorMessage("camera: {fx: -500}\n"), StartsWith("vehicle.yaml:1: camera.fx: must be above 0"));
  EXPECT_THAT(errorMessage("camera: {distortion: [1, 2, 3]}\n"), HasSubstr("has 3"));
}

TEST_F(ConfigurationLoader, AMissingFileIsNamed) {
  EXPECT_THROW(loadConfiguration(folder_ / "nothing.yaml"), ConfigurationError);
  EXPECT_THAT(errorMessage(""), HasSubstr("holds no keys"));
  EXPECT_THAT(errorMessage("just words"), HasSubstr("holds no keys"));
}

TEST_F(ConfigurationLoader, TheIncludingFileWinsAndTheCalibrationIsIncludedUnchanged) {
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

TEST_F(ConfigurationLoader, AFaultInAnIncludedFileNamesThatFile) {
  write("other.yaml", "\nwrong: 1\n");
  EXPECT_THAT(errorMessage(std::string("include: other.yaml\n") + kCamera),
              StartsWith("other.yaml:2: wrong: "));
}

TEST_F(ConfigurationLoader, FilesThatIncludeEachOtherAreRefused) {
  write("other.yaml", "vehicle: a\ninclude: vehicle.yaml\n");
  EXPECT_THAT(errorMessage(std::string("include: other.yaml\n") + kCamera),
              StartsWith("other.yaml:2: include: "));
  EXPECT_THAT(errorMessage("include: vehicle.yaml\n"), StartsWith("vehicle.yaml:1: include: "));
}

TEST_F(ConfigurationLoader, TargetsAreNotPlacedByAFixedCameraWhereAGimbalTurnsIt) {
  const std::string gimbal = kCamera + std::string("gimbal: {enabled: true}\ngeolocation: {enabled: true}\n");
  try {
    loadConfiguration(write("vehicle.yaml", gimbal));
    ADD_FAILURE();
  } catch (const ConfigurationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("geolocation.mount must be gimbal"));
  }
}

TEST_F(ConfigurationLoader, TheCommandLineIsCheckedWithTheWhole) {
  const fs::path file = write("vehicle.yaml", kCamera);
  const auto faultOf = [&](const std::string& preset, const std::string& setting) -> std::string {
    try {
      loadConfiguration(file, {preset, {setting}});
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(faultOf("vision_only", "visual.tracker.grid_px=16"), "");
  EXPECT_EQ(faultOf("", "gimbal.enabled=true"), "");
  EXPECT_THAT(
      faultOf("", "detection.objects.extent_threshold=0.9"),
      AllOf(StartsWith("command line: detection.objects.extent_threshold: "), HasSubstr("must not exceed")));
  EXPECT_THAT(faultOf("", "detection.objects.weak_threshold=0.9"), HasSubstr("must not exceed"));
  EXPECT_THAT(faultOf("", "detection.objects.max_missed_frames=24"),
              HasSubstr("was renamed to detection.objects.max_missed_s"));
  EXPECT_THAT(faultOf("", "detection.objects.threshold=0.3"),
              StartsWith("command line: detection.objects.threshold: "));
  EXPECT_THAT(faultOf("", "waits.visual_s=3"), HasSubstr("must be longer"));
  EXPECT_THAT(faultOf("", "visual.tracker.grid_px"), HasSubstr("expected key=value"));
  EXPECT_THAT(faultOf("", "segmentation.threshold=0.5"), HasSubstr("was renamed to"));
  EXPECT_THAT(faultOf("", "visual.tracker.grid_px=[1"), StartsWith("command line: visual.tracker.grid_px: "));
  EXPECT_THAT(faultOf("nonsense", "visual.tracker.grid_px=16"), HasSubstr("must be one of"));
}

}  // namespace
}  // namespace redbee::test
