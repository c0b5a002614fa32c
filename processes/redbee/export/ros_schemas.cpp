#include "processes/redbee/export/ros_schemas.hpp"

#include <utility>

namespace redbee {
namespace {

McapSchema ros2(std::string name, std::string text) { return {std::move(name), "ros2msg", std::move(text)}; }

std::string included(const std::string& name, const std::string& text) {
  return std::string(80, '=') + "\nMSG: " + name + "\n" + text;
}

std::string timeText() { return included("builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"); }

std::string headerText() {
  return included("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n") + timeText();
}

std::string vectorText() { return included("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"); }

}  // namespace

McapSchema compressedImageSchema() {
  return ros2(
      "foxglove_msgs/msg/CompressedImage",
      "builtin_interfaces/Time timestamp\nstring frame_id\nuint8[] data\nstring format\n" + timeText());
}

McapSchema rawImageSchema() {
  return ros2("foxglove_msgs/msg/RawImage",
              "builtin_interfaces/Time timestamp\nstring frame_id\nuint32 width\nuint32 height\n"
              "string encoding\nuint32 step\nuint8[] data\n" +
                  timeText());
}

McapSchema imageAnnotationsSchema() {
  const std::string metadata = "foxglove_msgs/KeyValuePair[] metadata\n";
  const std::string circle =
      "builtin_interfaces/Time timestamp\nfoxglove_msgs/Point2 position\nfloat64 diameter\nfloat64 "
      "thickness\n"
      "foxglove_msgs/Color fill_color\nfoxglove_msgs/Color outline_color\n" +
      metadata;
  const std::string points =
      "uint8 UNKNOWN=0\nuint8 POINTS=1\nuint8 LINE_LOOP=2\nuint8 LINE_STRIP=3\nuint8 LINE_LIST=4\n"
      "builtin_interfaces/Time timestamp\nuint8 type\nfoxglove_msgs/Point2[] points\n"
      "foxglove_msgs/Color outline_color\nfoxglove_msgs/Color[] outline_colors\n"
      "foxglove_msgs/Color fill_color\nfloat64 thickness\n" +
      metadata;
  const std::string text =
      "builtin_interfaces/Time timestamp\nfoxglove_msgs/Point2 position\nstring text\nfloat64 font_size\n"
      "foxglove_msgs/Color text_color\nfoxglove_msgs/Color background_color\n" +
      metadata;
  return ros2("foxglove_msgs/msg/ImageAnnotations",
              "builtin_interfaces/Time timestamp\nfoxglove_msgs/CircleAnnotation[] circles\n"
              "foxglove_msgs/PointsAnnotation[] points\nfoxglove_msgs/TextAnnotation[] texts\n" +
                  metadata + included("foxglove_msgs/CircleAnnotation", circle) +
                  included("foxglove_msgs/PointsAnnotation", points) +
                  included("foxglove_msgs/TextAnnotation", text) +
                  included("foxglove_msgs/Point2", "float64 x\nfloat64 y\n") +
                  included("foxglove_msgs/Color", "float64 r\nfloat64 g\nfloat64 b\nfloat64 a\n") +
                  included("foxglove_msgs/KeyValuePair", "string key\nstring value\n") + timeText());
}

McapSchema logSchema() {
  return ros2("foxglove_msgs/msg/Log",
              "uint8 UNKNOWN=0\nuint8 DEBUG=1\nuint8 INFO=2\nuint8 WARNING=3\nuint8 ERROR=4\nuint8 FATAL=5\n"
              "builtin_interfaces/Time timestamp\nuint8 level\nstring message\nstring name\nstring file\n"
              "uint32 line\n" +
                  timeText());
}

McapSchema imuSchema() {
  return ros2(
      "sensor_msgs/msg/Imu",
      "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
      "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
      "float64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n"
      "float64[9] linear_acceleration_covariance\n" +
          included("geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n") +
          vectorText() + headerText());
}

McapSchema rangeSchema() {
  return ros2(
      "sensor_msgs/msg/Range",
      "uint8 ULTRASOUND=0\nuint8 INFRARED=1\nstd_msgs/Header header\nuint8 radiation_type\n"
      "float32 field_of_view\nfloat32 min_range\nfloat32 max_range\nfloat32 range\nfloat32 variance\n" +
          headerText());
}

McapSchema cameraInfoSchema() {
  return ros2(
      "sensor_msgs/msg/CameraInfo",
      "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\n"
      "float64[9] k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\nuint32 binning_y\n"
      "sensor_msgs/RegionOfInterest roi\n" +
          included("sensor_msgs/RegionOfInterest",
                   "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n") +
          headerText());
}

McapSchema processHealthSchema() {
  return ros2("redbee_msgs/msg/ProcessHealth",
              "int8 STARTING=0\nint8 GOOD=1\nint8 DEGRADED=2\nint8 STOPPING=3\nint8 DEAD=4\n"
              "builtin_interfaces/Time timestamp\nint8 state\nfloat64 rate_in\nfloat64 rate_out\n"
              "float64 latency_median\nfloat64 latency_p99\nfloat64 work_median\nfloat64 work_p99\n"
              "int64 received\nint64 published\nint64 skipped\nint64 lost\nint64 damaged\nint64 late\n"
              "int64 resident\nstring message\n" +
                  timeText());
}

}  // namespace redbee
