// Our messages as ROS 2's and Foxglove's, serialised (ros_schemas.hpp).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "redbee/altimeter_t.hpp"
#include "redbee/detection/objects/object_tracker.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/geometry/camera_intrinsics.hpp"
#include "redbee/image_t.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/process_health_t.hpp"

namespace redbee {

using CdrBytes = std::vector<uint8_t>;

CdrBytes exportCompressedImage(int64_t utime, const std::vector<uint8_t>& data, const std::string& format);
/// RawImage; an encoding that Foxglove has none of is decoded to bgr8. Empty for an image that cannot be
/// decoded.
CdrBytes exportRawImage(const image_t& image);
/// One loop of lines and one text a box: its identity and score, grey where the tracker predicted it.
CdrBytes exportBoxes(int64_t utime, const std::vector<Detection>& boxes);
CdrBytes exportImu(const ins_t& imu);
CdrBytes exportRange(const altimeter_t& altitude);
CdrBytes exportCameraInfo(int64_t utime, const CameraIntrinsics& camera);
CdrBytes exportHealth(const process_health_t& health);
/// The health's line as a log message of the process.
CdrBytes exportLog(const process_health_t& health);

}  // namespace redbee
