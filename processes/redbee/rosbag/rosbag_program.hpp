// `redbee import rosbag` is a program of its own: nothing else loads ROS libraries, and a damaged bag that
// crashes them costs nothing else.
#pragma once

namespace redbee {

inline constexpr const char* kRosbagProgram = "redbee-import-rosbag";
inline constexpr const char* kRosbagName = "rosbag";
inline constexpr const char* kRosbagDescription =
    "ROS 1 bag: images, IMU, range, camera_info (for ROS 2's, see mcap)";

/// How to get it.
inline constexpr const char* kRosbagMissing =
    "scripts/setup scripts/packages-rosbag.txt installs ROS's library, then build again";

}  // namespace redbee
