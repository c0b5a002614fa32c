// ROS messages with any content. Input: a byte, then the message; the byte gives type and encoding.
#include <array>

#include "redbee/files/input_error.hpp"
#include "redbee/importers/ros/ros_images.hpp"
#include "redbee/importers/ros/ros_sensors.hpp"
#include "tests/fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  if (size == 0) return 0;
  static const std::array<std::string, 7> types{"sensor_msgs/Image",
                                                "sensor_msgs/CompressedImage",
                                                "sensor_msgs/Imu",
                                                "sensor_msgs/Range",
                                                "sensor_msgs/CameraInfo",
                                                "foxglove_msgs/msg/RawImage",
                                                "foxglove_msgs/msg/CompressedImage"};
  const RosEncoding encoding = data[0] % 2 == 0 ? RosEncoding::kRos1 : RosEncoding::kCdr;
  const RosTopic topic{"/topic", types[data[0] / 2 % types.size()], encoding, 1};
  const RosMessage message{&topic, 1, {data + 1, size - 1}};
  try {
    switch (rosKindOf(topic.type)) {
      case RosKind::kImu:
        readRosImu(message.bytes, encoding);
        break;
      case RosKind::kRange:
        readRosRange(message.bytes, encoding);
        break;
      case RosKind::kCameraInfo:
        intrinsicsOf(readRosCameraInfo(message.bytes, encoding), "/image", "f");
        break;
      default:
        convertRosImage(message, "f", {});
        valuesOf16BitRosImage(message, "f");
        break;
    }
  } catch (const RosMessageError&) {
  } catch (const InputError&) {
  }
  return 0;
}
