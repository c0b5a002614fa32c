// IMU, range and calibration of a recording of ROS messages.
#pragma once

#include <optional>
#include <vector>

#include "redbee/importers/import.hpp"
#include "redbee/importers/ros/ros_messages.hpp"
#include "redbee/importers/ros/ros_recording.hpp"

namespace redbee {

struct RosSensors {
  std::vector<ImuSample> imu;             ///< in the order of their times
  std::vector<AltitudeSample> altitudes;  ///< the same
  std::optional<RosCameraInfo> camera_info;
  std::vector<bool> keep_image;  ///< one for each message of the images: those whose times can be true
  std::vector<std::string> warnings;
};

/// Throws InputError; with options.keep_going damaged messages are left out, with a warning.
RosSensors readRosSensors(RosRecording& recording, const RosTopics& topics, const ImportOptions& options);

/// The camera that a camera_info states for images on `image_topic`: of the rectified image (P) where its
/// name says that it is one. std::nullopt where it is not calibrated. Throws InputError with `file` for a
/// distortion model that is not supported.
std::optional<CameraIntrinsics> intrinsicsOf(const RosCameraInfo& info, const std::string& image_topic,
                                             const std::filesystem::path& file);

/// What is wrong with one message: "F.bag: /imu0, message 12: is cut short".
std::string faultOfMessage(const std::filesystem::path& file, const std::string& topic, int64_t number,
                           const std::string& what);

}  // namespace redbee
