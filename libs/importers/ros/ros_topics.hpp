// Which topics of a recording are camera, IMU, altimeter and calibration.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "redbee/importers/ros/ros_recording.hpp"

namespace redbee {

/// What the user chose; empty: by type, if there is one of it. "none": not read.
struct RosTopicChoice {
  std::string image;
  std::string imu;
  std::string range;
  std::string camera_info;
};

struct RosTopics {
  RosTopic image;
  std::optional<RosTopic> imu;
  std::optional<RosTopic> range;
  std::optional<RosTopic> camera_info;
};

/// Of several camera_info topics, that of the image's own namespace is taken, as image_transport does. Throws
/// InputError with `file`, the option and the candidates where a topic is to be chosen or does not fit.
RosTopics chooseRosTopics(const std::vector<RosTopic>& topics, const RosTopicChoice& choice,
                          const std::filesystem::path& file);

}  // namespace redbee
