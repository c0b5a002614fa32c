// Common parts of all importers: a recording becomes an LCM log, and its calibration a vehicle configuration.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "redbee/files/log.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/importers/imu_units.hpp"
#include "redbee/importers/ros/ros_topics.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

/// Channel names in the log; the configuration's defaults.
struct ImportChannels {
  std::string camera = "CAMERA";
  std::string imu = "IMU";
  std::string altimeter = "ALTIMETER";
  std::string gimbal = "GIMBAL";
  std::string lens = "LENS";
};

enum class FrameFormat {
  kMjpeg,    ///< colour, JPEG
  kRawGrey,  ///< luma, uncompressed
};

/// Options of all importers; each ignores those that do not apply to its recordings (importer.hpp).
struct ImportOptions {
  std::filesystem::path source;  ///< file or folder
  /// Further files of the same recording, as a camera splits it.
  std::vector<std::filesystem::path> further_sources;
  std::filesystem::path log;  ///< to be written
  ImportChannels channels;
  FrameFormat format = FrameFormat::kMjpeg;  ///< of frames that are decoded
  int jpeg_quality = 90;                     ///< of frames that are encoded here
  int width = 0;  ///< px, at most; the height follows from the aspect ratio; 0: as recorded. Video files only
  double fps = 0;           ///< Hz, of a folder of images or a raw stream; other files have their own times
  bool keep_going = false;  ///< damage of a video is passed over
  /// See readImuCsv(). The axes are the IMU's; the vehicle's R_CI relates the camera to them.
  std::optional<std::filesystem::path> imu;
  ImuUnits units;         ///< of the IMU's samples where the recording does not state them
  RosTopicChoice topics;  ///< of a recording of ROS messages
  /// Kalibr's camchain.yaml or camchain-imucam.yaml; what it states counts before what the recording states.
  std::optional<std::filesystem::path> camchain;
  std::string camchain_camera = "cam0";  ///< its section of the camchain
};

/// What a recording states about its vehicle. Empty members are taken from the reference configuration.
struct VehicleDescription {
  std::string name;
  int width = 0;            ///< px
  int height = 0;           ///< px
  double pixel_aspect = 1;  ///< a pixel's width over its height
  std::optional<CameraIntrinsics> intrinsics;
  std::optional<Eigen::Matrix3d> R_CI;  ///< turns IMU coordinates into camera coordinates
  std::optional<Eigen::Vector3d> p_IC;  ///< m, camera centre in the IMU frame
  std::optional<double> timeshift_s;    ///< t_imu = t_cam + timeshift
  std::optional<ImuNoise> noise;
  std::optional<double>
      mount_sigma_deg;  ///< deg, of GIMBAL's angles, where the log says how the images were turned
  /// px, where the log says the focal length of each image: what LENS has where `intrinsics` hold.
  std::optional<double> lens_focal_px;
  bool has_imu = false;
  std::optional<AltitudeSample> start_height;  ///< altimeter at the first frame
};

struct ImportSummary {
  int64_t frames = 0;
  int64_t imu_samples = 0;
  int64_t altitudes = 0;
  int64_t first_utime = 0;  ///< us, first frame
  int64_t last_utime = 0;   ///< us, last frame
  double imu_rate_hz = 0;   ///< mean over the recording; 0 without an IMU
  VehicleDescription vehicle;
  std::vector<std::string> warnings;  ///< one line each
};

/// For a recording without intrinsics: principal point in the image centre, focal length 0.8 of the longer
/// side (64 degrees field of view, typical of drones and phones), with a warning. Vision alone depends on it
/// little; with an IMU it must be correct.
void assumeIntrinsics(ImportSummary& summary);

/// Warning if IMU samples do not cover all frames, otherwise std::nullopt.
std::optional<std::string> imuCoverageWarning(const std::vector<ImuSample>& imu, CameraTime first_frame,
                                              CameraTime last_frame);
/// The altitude at the first frame: the nearest within 0.2 s that lies above the ground.
std::optional<AltitudeSample> startHeight(const std::vector<AltitudeSample>& altitudes, ImuTime first_frame);
double meanRate(const std::vector<ImuSample>& imu);

}  // namespace redbee
