#include "redbee/configuration/configuration.hpp"

#include "tests/support/configuration_file.hpp"

namespace redbee::test {
namespace {

class ConfigurationTest : public ConfigurationFile {};

TEST_F(ConfigurationTest, TheCameraAloneIsEnough) {
  const auto configuration = load(kCamera);
  EXPECT_EQ(configuration.camera.width, 640);
  EXPECT_EQ(configuration.camera.cx, 319.5);
  EXPECT_EQ(configuration.channels.camera, "CAMERA");
  EXPECT_EQ(configuration.fusion.noise, FusionNoise::kPropagated);
}

TEST_F(ConfigurationTest, MatricesAreRowMajor) {
  const auto configuration = load(
      "camera: {width: 640, height: 480, fx: 1, fy: 1, cx: 0, cy: 0, "
      "R_CI: [0, -1, 0, 0, 0, -1, 1, 0, 0], p_IC: [1, 2, 3]}\n");
  const auto& extrinsics = configuration.inertial.extrinsics;
  EXPECT_EQ(extrinsics.R_CI * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ())
      << "forward is the optical axis";
  EXPECT_EQ(extrinsics.R_CI * Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY()) << "up is against y";
  EXPECT_EQ(extrinsics.p_IC, Eigen::Vector3d(1, 2, 3));
}

TEST_F(ConfigurationTest, DistortionMayLeaveOutK3) {
  const std::string camera = "camera: {width: 640, height: 480, fx: 1, fy: 1, cx: 0, cy: 0, distortion: ";
  EXPECT_EQ(load(camera + "[1, 2, 3, 4]}").camera.distortion, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(load(camera + "[1, 2, 3, 4, 5]}").camera.distortion[4], 5);
}

TEST_F(ConfigurationTest, AnEquidistantLensHasFourCoefficients) {
  const std::string camera =
      "camera: {width: 640, height: 480, fx: 1, fy: 1, cx: 0, cy: 0, model: equidistant, distortion: ";
  const auto configuration = load(camera + "[1, 2, 3, 4]}");
  EXPECT_EQ(configuration.camera.model, "equidistant");
  EXPECT_EQ(configuration.camera.distortion, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_THROW(load(camera + "[1, 2, 3, 4, 5]}"), ConfigurationError);
  EXPECT_THROW(load("camera: {width: 640, height: 480, fx: 1, fy: 1, cx: 0, cy: 0, model: omni}"),
               ConfigurationError);
}

TEST_F(ConfigurationTest, RenamedKeysLeadToKeysThatExist) {
  const fs::path file = write("vehicle.yaml", kCamera);
  for (const char* old_key :
       {"segmentation.threshold", "segmentation.use_shadow_test", "segmentation.edge_doubt_px",
        "visual.min_sharpness_share", "channels.inertial_state"}) {
    std::string message;
    try {
      loadConfiguration(file, {"", {std::string(old_key) + "=1"}});
    } catch (const ConfigurationError& error) {
      message = error.what();
    }
    const std::string announced = "was renamed to ";
    ASSERT_THAT(message, testing::HasSubstr(announced)) << old_key;
    const std::string new_key = message.substr(message.find(announced) + announced.size());
    EXPECT_THAT(configurationKeys(), testing::Contains(new_key)) << old_key;
  }
}

TEST_F(ConfigurationTest, TheVisionOnlyPresetHasLowerThresholds) {
  const Configuration configuration = load(std::string(kCamera) + "preset: vision_only\n");
  EXPECT_EQ(configuration.detection.objects.threshold, 0.25);
  EXPECT_EQ(configuration.detection.objects.weak_threshold, 0.18);
  EXPECT_EQ(configuration.detection.objects.extent_threshold, 0.12);
}

TEST_F(ConfigurationTest, ThePaperPresetHasThePapersValues) {
  const auto paper = load(std::string(kCamera) + "preset: paper\n");
  EXPECT_EQ(paper.fusion.noise, FusionNoise::kPaper);
  EXPECT_EQ(paper.fusion.paper_Q[2], 1.0);
  EXPECT_EQ(paper.fusion.paper_P0[2], 1e-4);
  EXPECT_EQ(paper.detection.method, "two_planes");
  EXPECT_EQ(paper.detection.refinement.gamma, 0.6);
  EXPECT_EQ(configurationHash(load(std::string(kCamera) + "preset: default\n")),
            configurationHash(load(kCamera)));
}

TEST_F(ConfigurationTest, APresetWinsOverIncludesAndLosesToItsOwnFile) {
  write("base.yaml",
        std::string(kCamera) + "fusion: {noise: propagated}\ndetection: {refinement: {alpha: 0.9}}\n");
  const auto configuration =
      load("include: base.yaml\npreset: paper\ndetection: {refinement: {beta: 0.7}}\n");
  EXPECT_EQ(configuration.fusion.noise, FusionNoise::kPaper);
  EXPECT_EQ(configuration.detection.refinement.alpha, 0.4);
  EXPECT_EQ(configuration.detection.refinement.beta, 0.7);
}

TEST_F(ConfigurationTest, EmittedYamlLoadsBackToTheSameHash) {
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

TEST_F(ConfigurationTest, TheHashDependsOnTheContentAlone) {
  const auto plain = configurationHash(load(kCamera));
  EXPECT_EQ(plain.size(), 16U);
  EXPECT_EQ(configurationHash(load("# a comment\ncamera:\n  cy: 239.50\n  cx: 319.5\n  fy: 5e2\n  fx: 500.0\n"
                                   "  height: 480\n  width: 640\nwatch: {hang_timeout_s: 2.0}\n")),
            plain);
  EXPECT_NE(configurationHash(load(std::string(kCamera) + "watch: {hang_timeout_s: 3.0}\n")), plain);
}

}  // namespace
}  // namespace redbee::test
