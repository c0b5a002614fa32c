#include "processes/redbee/vehicle/import_kalibr.hpp"

#include "redbee/configuration/configuration.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

/// As Kalibr writes it (github.com/ethz-asl/kalibr/wiki/yaml-formats), of a fisheye camera turned by a
/// quarter.
const char* const kCamchain =
    "cam0:\n"
    "  T_cam_imu:\n"
    "  - [0.0, -1.0, 0.0, 0.1]\n"
    "  - [1.0, 0.0, 0.0, 0.2]\n"
    "  - [0.0, 0.0, 1.0, 0.3]\n"
    "  - [0.0, 0.0, 0.0, 1.0]\n"
    "  cam_overlaps: [1]\n"
    "  camera_model: pinhole\n"
    "  distortion_coeffs: [-0.0034, 0.0007, -0.002, 0.0002]\n"
    "  distortion_model: equidistant\n"
    "  intrinsics: [190.97, 190.97, 254.93, 256.89]\n"
    "  resolution: [512, 512]\n"
    "  rostopic: /cam0/image_raw\n"
    "  timeshift_cam_imu: -0.0125\n";

/// As it is given to Kalibr.
const char* const kImu =
    "#Accelerometers\n"
    "accelerometer_noise_density: 1.86e-03   #Noise density (continuous-time)\n"
    "accelerometer_random_walk:   4.33e-04   #Bias random walk\n"
    "gyroscope_noise_density:     1.87e-04\n"
    "gyroscope_random_walk:       2.66e-05\n"
    "rostopic:                    /imu0      #the IMU ROS topic\n"
    "update_rate:                 200.0\n";

/// As Kalibr gives it back.
const char* const kImuResult =
    "imu0:\n"
    "  T_i_b:\n"
    "  - [1.0, 0.0, 0.0, 0.0]\n"
    "  - [0.0, 1.0, 0.0, 0.0]\n"
    "  - [0.0, 0.0, 1.0, 0.0]\n"
    "  - [0.0, 0.0, 0.0, 1.0]\n"
    "  accelerometer_noise_density: 0.00186\n"
    "  accelerometer_random_walk: 0.000433\n"
    "  gyroscope_noise_density: 0.000187\n"
    "  gyroscope_random_walk: 2.66e-05\n"
    "  model: calibrated\n"
    "  rostopic: /imu0\n"
    "  time_offset: 0.0\n"
    "  update_rate: 200.0\n";

class ImportKalibrTest : public testing::Test {
 protected:
  ImportKalibrTest() {
    options_.camchain = folder_ / "camchain-imucam.yaml";
    options_.imu = folder_ / "imu.yaml";
    options_.out = folder_ / "drone.yaml";
    writeText(options_.camchain, kCamchain);
    writeText(*options_.imu, kImu);
  }
  void expectError(const std::string& part) const {
    const std::string line = errorMessageOf([&] { importKalibr(options_); });
    EXPECT_NE(line.find(part), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_FALSE(fs::exists(options_.out));
  }
  static std::string replaced(std::string text, const std::string& what, const std::string& by) {
    return text.replace(text.find(what), what.size(), by);
  }
  ScratchFolder folder_;
  KalibrImport options_;
};

TEST_F(ImportKalibrTest, AMatrixThatIsNoPoseIsRefused) {
  for (const char* row : {"[0.0, 0.0, 0.0, 2.0]", "[0.0, 0.1, 0.0, 1.0]", "[0.1, 0.2, 0.3, 1.0]"}) {
    writeText(options_.camchain, replaced(kCamchain, "[0.0, 0.0, 0.0, 1.0]", row));
    expectError("camchain-imucam.yaml:3: T_cam_imu: its last row is not 0 0 0 1");
  }
}

TEST_F(ImportKalibrTest, ACamchainMayStateTheInverse) {
  importKalibr(options_);
  const InertialExtrinsics expected = loadConfiguration(options_.out).inertial.extrinsics;
  fs::remove(options_.out);
  // As OpenVINS writes it: the inverse of kCamchain's, by hand (R', and -R' t).
  writeText(options_.camchain, replaced(kCamchain,
                                        "  T_cam_imu:\n  - [0.0, -1.0, 0.0, 0.1]\n  - [1.0, 0.0, 0.0, 0.2]\n"
                                        "  - [0.0, 0.0, 1.0, 0.3]\n",
                                        "  T_imu_cam:\n  - [0.0, 1.0, 0.0, -0.2]\n  - [-1.0, 0.0, 0.0, 0.1]\n"
                                        "  - [0.0, 0.0, 1.0, -0.3]\n"));
  EXPECT_TRUE(importKalibr(options_).empty());
  const InertialExtrinsics extrinsics = loadConfiguration(options_.out).inertial.extrinsics;
  EXPECT_LT((extrinsics.R_CI - expected.R_CI).norm(), 1e-12);
  EXPECT_LT((extrinsics.p_IC - expected.p_IC).norm(), 1e-12);
}

TEST_F(ImportKalibrTest, WhatTheConfigurationRefusesIsTheCamchains) {
  writeText(options_.camchain, replaced(kCamchain, "[512, 512]", "[512, 2000000]"));
  expectError(options_.camchain.string() + " and " + options_.imu->string() + ": gives no vehicle: camera.");
  const std::string line = errorMessageOf([&] { importKalibr(options_); });
  EXPECT_EQ(line.find("drone.yaml"), std::string::npos) << line;
}

TEST_F(ImportKalibrTest, CameraAndImuAreTheVehicles) {
  for (const char* imu : {kImu, kImuResult}) {
    writeText(*options_.imu, imu);
    EXPECT_TRUE(importKalibr(options_).empty());
    const Configuration vehicle = loadConfiguration(options_.out);
    EXPECT_EQ(vehicle.vehicle, "drone");
    EXPECT_EQ(vehicle.camera.model, "equidistant");
    EXPECT_EQ(vehicle.camera.width, 512);
    EXPECT_DOUBLE_EQ(vehicle.camera.cy, 256.89);
    EXPECT_DOUBLE_EQ(vehicle.camera.distortion[2], -0.002);
    const InertialExtrinsics& extrinsics = vehicle.inertial.extrinsics;
    EXPECT_DOUBLE_EQ(extrinsics.R_CI(0, 1), -1);
    // The camera's centre, by hand: -R' t with R = [0 -1 0; 1 0 0; 0 0 1] and t = (.1, .2, .3).
    EXPECT_LT((extrinsics.p_IC - Eigen::Vector3d(-0.2, 0.1, -0.3)).norm(), 1e-12);
    EXPECT_DOUBLE_EQ(extrinsics.timeshift_s, -0.0125);
    EXPECT_TRUE(vehicle.has_imu);
    EXPECT_DOUBLE_EQ(vehicle.inertial.noise.gyro_noise_density, 1.87e-4);
    EXPECT_DOUBLE_EQ(vehicle.inertial.noise.accel_random_walk, 4.33e-4);
    fs::remove(options_.out);
  }
}

TEST_F(ImportKalibrTest, WhatIsMissingIsSaid) {
  options_.imu.reset();
  ASSERT_EQ(importKalibr(options_).size(), 1u);
  EXPECT_FALSE(loadConfiguration(options_.out).has_imu);
}

TEST_F(ImportKalibrTest, AnExistingFileStays) {
  importKalibr(options_);
  const std::string before = readText(options_.out);
  EXPECT_NE(errorMessageOf([&] { importKalibr(options_); }).find("exists"), std::string::npos);
  EXPECT_EQ(readText(options_.out), before);
}

TEST_F(ImportKalibrTest, WhatDoesNotFitIsRefused) {
  writeText(options_.camchain, replaced(kCamchain, "-0.0125", "-12.5"));
  expectError("timeshift_cam_imu: -12.5");
  writeText(options_.camchain, replaced(kCamchain, "0.0, 0.1]", "0.0, 100]"));
  expectError("is its translation in m?");
  writeText(options_.camchain, replaced(kCamchain, "pinhole", "omni"));
  expectError("camera_model: 'omni' is not supported");
  writeText(options_.camchain, kImu);
  expectError("holds no 'cam0': is it a camchain?");
  writeText(options_.camchain, kCamchain);
  options_.camera = "cam1";
  expectError("holds no 'cam1'");
  options_.camera = "cam0";
  writeText(*options_.imu, replaced(kImuResult, "[1.0, 0.0, 0.0, 0.0]", "[1.0, 0.0, 0.0, 0.2]"));
  expectError("imu.yaml:3: T_i_b: is not the identity");
  writeText(*options_.imu, replaced(kImu, "1.87e-04", "0"));
  expectError("gyroscope_noise_density: must be a positive number");
  writeText(*options_.imu, kCamchain);
  expectError("key 'gyroscope_noise_density' is missing");
}

}  // namespace
}  // namespace redbee::test
