// The messages that come in from ROS: sensor_msgs of both generations, and Foxglove's images.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "redbee/importers/ros/ros_reader.hpp"

namespace redbee {

/// What a type is to us.
enum class RosKind { kImage, kCompressedImage, kImu, kRange, kCameraInfo, kOther };

/// `type`: as "sensor_msgs/Image", "sensor_msgs/msg/Image" or "foxglove_msgs/msg/RawImage".
RosKind rosKindOf(const std::string& type);

struct RosImage {
  int64_t stamp_ns = 0;  ///< 0: the driver gave none
  uint32_t width = 0;    ///< px
  uint32_t height = 0;   ///< px
  std::string encoding;  ///< sensor_msgs/image_encodings.h
  bool is_big_endian = false;
  uint32_t step = 0;  ///< bytes of a row
  ByteView data;
};
struct RosCompressedImage {
  int64_t stamp_ns = 0;
  std::string format;
  ByteView data;
};
struct RosImu {
  int64_t stamp_ns = 0;
  Eigen::Vector3d gyro;   ///< rad/s
  Eigen::Vector3d accel;  ///< m/s^2, specific force
  bool has_gyro = false;  ///< by the covariances, whose first entry is -1 where a sensor is missing
  bool has_accel = false;
};
struct RosRange {
  int64_t stamp_ns = 0;
  double range = 0;     ///< m
  double least = 0;     ///< m
  double most = 0;      ///< m
  double variance = 0;  ///< m^2; 0: not known (ROS 1, ROS 2 before Jazzy)
};
struct RosCameraInfo {
  uint32_t width = 0;   ///< px
  uint32_t height = 0;  ///< px
  std::string distortion_model;
  std::vector<double> D;
  std::array<double, 9> K{};   ///< row by row
  std::array<double, 12> P{};  ///< row by row, of the rectified image
};

/// Of an image, compressed or not.
int64_t readRosImageStamp(const std::string& type, ByteView bytes, RosEncoding encoding);
/// `type` decides between sensor_msgs and foxglove_msgs. Throw RosMessageError; views point into `bytes`.
RosImage readRosImage(const std::string& type, ByteView bytes, RosEncoding encoding);
RosCompressedImage readRosCompressedImage(const std::string& type, ByteView bytes, RosEncoding encoding);
RosImu readRosImu(ByteView bytes, RosEncoding encoding);
RosRange readRosRange(ByteView bytes, RosEncoding encoding);
RosCameraInfo readRosCameraInfo(ByteView bytes, RosEncoding encoding);

}  // namespace redbee
