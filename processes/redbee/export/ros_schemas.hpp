// The definitions of the messages that are exported, as ROS 2 writes them into MCAP (ros2msg).
#pragma once

#include "redbee/files/mcap_format.hpp"

namespace redbee {

// Foxglove's, github.com/foxglove/foxglove-sdk.
McapSchema compressedImageSchema();
McapSchema rawImageSchema();
McapSchema imageAnnotationsSchema();
McapSchema logSchema();
// ROS 2's sensor_msgs.
McapSchema imuSchema();
McapSchema rangeSchema();
McapSchema cameraInfoSchema();
/// redbee_msgs/msg/ProcessHealth: the numbers of process_health_t, to be plotted.
McapSchema processHealthSchema();

}  // namespace redbee
