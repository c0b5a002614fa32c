// sensor.yaml of the ASL layout, and Kalibr's camchain.yaml and imu.yaml.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "redbee/geometry/camera.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

/// Pose of a sensor S in the body B: x_B = R_BS x_S + p_BS.
struct SensorPose {
  Eigen::Matrix3d R_BS = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_BS = Eigen::Vector3d::Zero();
};

struct CameraSensor {
  CameraIntrinsics intrinsics;
  std::optional<SensorPose> pose;
};
/// A camera of Kalibr's camchain.yaml or camchain-imucam.yaml; the latter has the rest as well.
struct CamchainCamera {
  CameraIntrinsics intrinsics;
  std::optional<Eigen::Matrix3d> R_CI;  ///< of T_cam_imu
  std::optional<Eigen::Vector3d> p_IC;  ///< m
  std::optional<double> timeshift_s;    ///< timeshift_cam_imu: t_imu = t_cam + timeshift
};
struct ImuSensor {
  std::optional<ImuNoise> noise;
  std::optional<SensorPose> pose;
};

/// Content of a rendered flight's groundtruth.yaml about the camera.
struct TrueExtrinsics {
  SensorPose pose;         ///< of cam0, T_BS_cam0_true
  double timeshift_s = 0;  ///< time_offset_s: t_imu = t_cam + timeshift
};

/// All throw InputError with file and line. OpenCV's "%YAML:1.0" line is skipped.
CameraSensor readCameraSensor(const std::filesystem::path& file);
CamchainCamera readCamchain(const std::filesystem::path& file, const std::string& camera = "cam0");
/// Kalibr's imu.yaml as it is given to Kalibr, or the imu-*.yaml that it writes (section imu0).
ImuNoise readKalibrImu(const std::filesystem::path& file);
ImuSensor readImuSensor(const std::filesystem::path& file);
/// noise_sigma [m] of an altimeter.
double readAltimeterSigma(const std::filesystem::path& file);
TrueExtrinsics readTrueCameraExtrinsics(const std::filesystem::path& file);

}  // namespace redbee
