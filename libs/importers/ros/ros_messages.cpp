#include "redbee/importers/ros/ros_messages.hpp"

#include <map>

namespace redbee {
namespace {

bool isFoxglove(const std::string& type) { return type.rfind("foxglove", 0) == 0; }

int64_t readStamp(RosReader& reader) {
  constexpr int64_t kNanoseconds = 1'000'000'000;
  const int64_t seconds = reader.encoding() == RosEncoding::kRos1 ? int64_t{reader.number<uint32_t>()}
                                                                  : int64_t{reader.number<int32_t>()};
  const auto nanoseconds = reader.number<uint32_t>();
  if (nanoseconds >= kNanoseconds) throw RosMessageError("has a stamp of a second and more nanoseconds");
  return kNanoseconds * seconds + nanoseconds;
}

/// std_msgs/Header. The stamp.
int64_t readHeader(RosReader& reader) {
  if (reader.encoding() == RosEncoding::kRos1) reader.number<uint32_t>();  // seq
  const int64_t stamp = readStamp(reader);
  reader.string();  // frame_id
  return stamp;
}

template <size_t kCount>
std::array<double, kCount> readDoubles(RosReader& reader) {
  std::array<double, kCount> values;
  for (double& value : values) value = reader.number<double>();
  return values;
}

}  // namespace

RosKind rosKindOf(const std::string& type) {
  static const std::map<std::string, RosKind> kinds{
      {"sensor_msgs/Image", RosKind::kImage},
      {"sensor_msgs/CompressedImage", RosKind::kCompressedImage},
      {"sensor_msgs/Imu", RosKind::kImu},
      {"sensor_msgs/Range", RosKind::kRange},
      {"sensor_msgs/CameraInfo", RosKind::kCameraInfo},
      {"foxglove_msgs/RawImage", RosKind::kImage},
      {"foxglove_msgs/CompressedImage", RosKind::kCompressedImage},
  };
  std::string name = type;
  if (const size_t at = name.find("/msg/"); at != std::string::npos) name.erase(at, 4);
  const auto found = kinds.find(name);
  return found == kinds.end() ? RosKind::kOther : found->second;
}

int64_t readRosImageStamp(const std::string& type, ByteView bytes, RosEncoding encoding) {
  RosReader reader(bytes, encoding);
  return isFoxglove(type) ? readStamp(reader) : readHeader(reader);
}

RosImage readRosImage(const std::string& type, ByteView bytes, RosEncoding encoding) {
  RosReader reader(bytes, encoding);
  RosImage image;
  if (isFoxglove(type)) {
    image.stamp_ns = readStamp(reader);
    reader.string();  // frame_id
    image.width = reader.number<uint32_t>();
    image.height = reader.number<uint32_t>();
    image.encoding = reader.string();
  } else {
    image.stamp_ns = readHeader(reader);
    image.height = reader.number<uint32_t>();
    image.width = reader.number<uint32_t>();
    image.encoding = reader.string();
    image.is_big_endian = reader.number<uint8_t>() != 0;
  }
  image.step = reader.number<uint32_t>();
  image.data = reader.bytes();
  return image;
}

RosCompressedImage readRosCompressedImage(const std::string& type, ByteView bytes, RosEncoding encoding) {
  RosReader reader(bytes, encoding);
  RosCompressedImage image;
  if (isFoxglove(type)) {
    image.stamp_ns = readStamp(reader);
    reader.string();  // frame_id
    image.data = reader.bytes();
    image.format = reader.string();
  } else {
    image.stamp_ns = readHeader(reader);
    image.format = reader.string();
    image.data = reader.bytes();
  }
  return image;
}

RosImu readRosImu(ByteView bytes, RosEncoding encoding) {
  constexpr double kMissing = -1;
  RosReader reader(bytes, encoding);
  RosImu imu;
  imu.stamp_ns = readHeader(reader);
  readDoubles<4>(reader);  // orientation
  readDoubles<9>(reader);
  imu.gyro = Eigen::Vector3d(readDoubles<3>(reader).data());
  imu.has_gyro = readDoubles<9>(reader)[0] != kMissing;
  imu.accel = Eigen::Vector3d(readDoubles<3>(reader).data());
  imu.has_accel = readDoubles<9>(reader)[0] != kMissing;
  return imu;
}

RosRange readRosRange(ByteView bytes, RosEncoding encoding) {
  RosReader reader(bytes, encoding);
  RosRange range;
  range.stamp_ns = readHeader(reader);
  reader.number<uint8_t>();  // radiation_type
  reader.number<float>();    // field_of_view
  range.least = reader.number<float>();
  range.most = reader.number<float>();
  range.range = reader.number<float>();
  if (reader.left() >= sizeof(float)) range.variance = reader.number<float>();
  return range;
}

RosCameraInfo readRosCameraInfo(ByteView bytes, RosEncoding encoding) {
  RosReader reader(bytes, encoding);
  RosCameraInfo info;
  readHeader(reader);
  info.height = reader.number<uint32_t>();
  info.width = reader.number<uint32_t>();
  info.distortion_model = reader.string();
  info.D.resize(reader.count(sizeof(double)));
  for (double& coefficient : info.D) coefficient = reader.number<double>();
  info.K = readDoubles<9>(reader);
  readDoubles<9>(reader);  // R
  info.P = readDoubles<12>(reader);
  return info;
}

}  // namespace redbee
