// A ROS 1 bag, read by ROS's own library.
#pragma once

#include <filesystem>
#include <memory>

#include "redbee/importers/ros/ros_recording.hpp"

namespace redbee {

/// Throws InputError with the fix if the file is no bag, damaged or not indexed.
std::unique_ptr<RosRecording> openBag(const std::filesystem::path& file);

}  // namespace redbee
