#include "redbee/importers/sensor_yaml.hpp"

#include <yaml-cpp/yaml.h>

#include "processes/redbee/vehicle/vehicle_file.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/importers/importer.hpp"
#include "tests/support/asl_folder.hpp"

namespace redbee::test {
namespace {

// Kalibr's own layout: two cameras, a matrix as a list of rows, the second camera from the first.
constexpr const char* kCamchain =
    "cam0:\n"
    "  T_cam_imu:\n"
    "  - [0.0, -1.0, 0.0, 0.2]\n"
    "  - [0.0, 0.0, -1.0, 0.3]\n"
    "  - [1.0, 0.0, 0.0, -0.1]\n"
    "  - [0.0, 0.0, 0.0, 1.0]\n"
    "  cam_overlaps: [1]\n"
    "  camera_model: pinhole\n"
    "  distortion_coeffs: [-0.018, 0.0075, -0.0042, 0.0006]\n"
    "  distortion_model: equidistant\n"
    "  intrinsics: [100.0, 102.0, 63.5, 47.5]\n"
    "  resolution: [128, 96]\n"
    "  rostopic: /cam0/image_raw\n"
    "  timeshift_cam_imu: 0.005\n"
    "cam1:\n"
    "  camera_model: pinhole\n"
    "  distortion_coeffs: [0.1, 0.01, 0.0, 0.0]\n"
    "  distortion_model: radtan\n"
    "  intrinsics: [110.0, 111.0, 63.5, 47.5]\n"
    "  resolution: [128, 96]\n";

class CamchainTest : public AslFolder {
 protected:
  CamchainTest() {
    writeText(file(), kCamchain);
    options_.source = mav();
    options_.log = log();
    options_.camchain = file();
  }
  fs::path file() const { return mav() / "camchain-imucam.yaml"; }
  ImportSummary importWithCamchain() const {
    Progress progress("importing", "frames", true);
    return importRecording(aslImporter(), options_, progress);
  }
  ImportOptions options_;
};

TEST_F(CamchainTest, ACameraIsReadWithItsModelAndMounting) {
  const CamchainCamera camera = readCamchain(file());
  EXPECT_EQ(camera.intrinsics.model, "equidistant");
  EXPECT_EQ(camera.intrinsics.width, 128);
  EXPECT_EQ(camera.intrinsics.fy, 102);
  EXPECT_EQ(camera.intrinsics.distortion, (std::vector<double>{-0.018, 0.0075, -0.0042, 0.0006}));
  ASSERT_TRUE(camera.R_CI && camera.p_IC);
  // The IMU's x axis is the camera's z axis; the camera's centre is where T_cam_imu maps to zero.
  EXPECT_LT((*camera.R_CI * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((*camera.R_CI * *camera.p_IC + Eigen::Vector3d(0.2, 0.3, -0.1)).norm(), 1e-12);
  EXPECT_EQ(camera.timeshift_s, 0.005);
}

TEST_F(CamchainTest, AnotherCameraOfTheChain) {
  const CamchainCamera camera = readCamchain(file(), "cam1");
  EXPECT_EQ(camera.intrinsics.model, "radtan");
  EXPECT_EQ(camera.intrinsics.fx, 110);
  EXPECT_FALSE(camera.R_CI || camera.timeshift_s);
}

TEST_F(CamchainTest, FaultsAreNamedWithFileAndLine) {
  EXPECT_NE(errorMessageOf([&] { readCamchain(file(), "cam2"); }).find("holds no 'cam2'"), std::string::npos);
  EXPECT_NE(errorMessageOf([&] { readCamchain(mav() / "imu0" / "sensor.yaml"); }).find("is it a camchain?"),
            std::string::npos);
  writeText(file(), std::string(kCamchain).replace(std::string(kCamchain).find("0.0006]"), 7, "0.0006, 1]"));
  EXPECT_NE(errorMessageOf([&] { readCamchain(file()); }).find("camchain-imucam.yaml:9: distortion_coeffs"),
            std::string::npos);
}

TEST_F(CamchainTest, AnImportTakesTheCameraFromItAtTheSizeOfTheImages) {
  const VehicleDescription vehicle = importWithCamchain().vehicle;
  ASSERT_TRUE(vehicle.intrinsics);
  EXPECT_EQ(vehicle.intrinsics->width, 64);  // half of the calibrated size
  EXPECT_EQ(vehicle.intrinsics->fx, 50);
  EXPECT_EQ(vehicle.intrinsics->cx, 31.5);
  const Configuration configuration = loadConfiguration(writeVehicleFile(vehicle, log()));
  EXPECT_EQ(configuration.camera.model, "equidistant");
  EXPECT_EQ(configuration.inertial.extrinsics.timeshift_s, 0.005);
  EXPECT_LT(
      (configuration.inertial.extrinsics.R_CI * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitZ()).norm(),
      1e-12);
}

TEST_F(CamchainTest, AnotherAspectRatioIsRefusedAndLeavesNoLog) {
  writeText(file(), std::string(kCamchain).replace(std::string(kCamchain).find("128, 96"), 7, "128, 72"));
  const std::string complaint = errorMessageOf([&] { importWithCamchain(); });
  EXPECT_NE(complaint.find("is 128x72, the images are 64x48"), std::string::npos) << complaint;
  EXPECT_FALSE(fs::exists(log()));
}

TEST_F(CamchainTest, ARollingShuttersLineDelayReachesTheVehicleFile) {
  const fs::path sensor = mav() / "cam0" / "sensor.yaml";
  const std::string text = readText(sensor);
  EXPECT_EQ(readCameraSensor(sensor).intrinsics.line_delay_s, 0);
  writeText(sensor, text + "line_delay_s: 5.2e-05\n");
  const CameraIntrinsics camera = readCameraSensor(sensor).intrinsics;
  EXPECT_EQ(camera.line_delay_s, 5.2e-05);
  VehicleDescription vehicle;
  vehicle.name = "rolling";
  vehicle.width = camera.width;
  vehicle.height = camera.height;
  vehicle.intrinsics = camera;
  EXPECT_EQ(loadConfiguration(writeVehicleFile(vehicle, log())).camera.line_delay_s, 5.2e-05);
  writeText(sensor, text + "line_delay_s: 25\n");
  EXPECT_NE(errorMessageOf([&] { readCameraSensor(sensor); }).find("line_delay_s: must lie from"),
            std::string::npos);
}

TEST_F(CamchainTest, AFisheyeOfTheAslLayout) {
  const fs::path sensor = mav() / "cam0" / "sensor.yaml";
  std::string text = readText(sensor);
  const std::string radtan = "radial-tangential";
  text.replace(text.find(radtan), radtan.size(), "equidistant");
  writeText(sensor, text);
  const CameraIntrinsics camera = readCameraSensor(sensor).intrinsics;
  EXPECT_EQ(camera.model, "equidistant");
  EXPECT_EQ(camera.distortion.size(), 4u);
}

}  // namespace
}  // namespace redbee::test
