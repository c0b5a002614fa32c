// Against bytes written by hand, as OMG's CDR and ROS 1 have them; other implementations are in
// tests/integration/speaks_mcap and tests/rosbag.
#include "redbee/importers/ros/ros_messages.hpp"

#include <gtest/gtest.h>

#include "redbee/importers/ros/ros_images.hpp"

namespace redbee::test {
namespace {

using Bytes = std::vector<uint8_t>;

ByteView view(const Bytes& bytes) { return {bytes.data(), bytes.size()}; }

TEST(RosReader, CdrAlignsToTheEndOfItsHeader) {
  // A byte, three of padding, 1 as uint32, a double of 1 at 8 after the header: here without padding.
  const Bytes little{0, 1, 0, 0, 7, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F};
  RosReader reader(view(little), RosEncoding::kCdr);
  EXPECT_EQ(reader.number<uint8_t>(), 7);
  EXPECT_EQ(reader.number<uint32_t>(), 1u);
  EXPECT_EQ(reader.number<double>(), 1);
  EXPECT_EQ(reader.left(), 0u);
}

TEST(RosReader, TheHeaderGivesTheByteOrder) {
  const Bytes big{0, 0, 0, 0, 0, 0, 0, 3, 'a', 'b', 0, 0, 0x3F, 0x80, 0, 0};
  RosReader reader(view(big), RosEncoding::kCdr);
  EXPECT_EQ(reader.string(), "ab");
  EXPECT_EQ(reader.number<float>(), 1);
}

TEST(RosReader, PlainCdr2AlignsToFourAtMost) {
  const Bytes bytes{0, 7, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F};
  RosReader reader(view(bytes), RosEncoding::kCdr);
  reader.number<uint32_t>();
  EXPECT_EQ(reader.number<double>(), 1);
}

TEST(RosReader, LengthsBeyondTheBytesAreRefusedBeforeAnythingIsAllocated) {
  const Bytes bytes{0xFF, 0xFF, 0xFF, 0xFF, 1};
  for (int field = 0; field < 3; ++field) {
    RosReader reader(view(bytes), RosEncoding::kRos1);
    const auto read = [&] {
      if (field == 0) reader.string();
      if (field == 1) reader.bytes();
      if (field == 2) reader.count(8);
    };
    EXPECT_THROW(read(), RosMessageError);
  }
  EXPECT_THROW(RosReader(view({0, 3, 0, 0}), RosEncoding::kCdr), RosMessageError);  // parameter list
  EXPECT_THROW(RosReader(view({0}), RosEncoding::kCdr), RosMessageError);
}

TEST(RosMessages, ARos1ImageIsPacked) {
  // Header: sequence, stamp 2 s 5 ns, frame "c"; then 1 row of 2 px.
  const Bytes bytes{9, 0, 0, 0, 2, 0, 0,   0,   5,   0,   0,   0, 1, 0, 0, 0, 'c', 1, 0, 0, 0,  2, 0,
                    0, 0, 5, 0, 0, 0, 'm', 'o', 'n', 'o', '8', 0, 2, 0, 0, 0, 2,   0, 0, 0, 40, 50};
  const RosImage image = readRosImage("sensor_msgs/Image", view(bytes), RosEncoding::kRos1);
  EXPECT_EQ(image.stamp_ns, 2'000'000'005);
  EXPECT_EQ(image.width, 2u);
  EXPECT_EQ(image.height, 1u);
  EXPECT_EQ(image.encoding, "mono8");
  EXPECT_EQ(image.step, 2u);
  ASSERT_EQ(image.data.size, 2u);
  EXPECT_EQ(image.data.data[1], 50);
  for (size_t size = 0; size < bytes.size(); ++size) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<long>(size));
    EXPECT_THROW(readRosImage("sensor_msgs/Image", view(cut), RosEncoding::kRos1), RosMessageError) << size;
  }
}

/// A ROS 1 message of an image: header, then what `fields` holds.
std::string refusalOf(const char* type, const std::string& fields) {
  const std::string text = std::string(12, '\0') + std::string(4, '\0') + fields;
  const Bytes bytes(text.begin(), text.end());
  const RosTopic topic{"/cam", type, RosEncoding::kRos1, 1};
  try {
    convertRosImage({&topic, 0, view(bytes)}, "f.bag", {});
  } catch (const RosMessageError& error) {
    return error.what();
  }
  return "";
}

TEST(RosMessages, WhatIsNotReadIsShownBesideWhatIs) {
  const std::string one("\1\0\0\0", 4), four("\4\0\0\0", 4);
  const std::string image = one + one + four + "nv12" + std::string(1, '\0') + one + one + "x";
  EXPECT_EQ(
      refusalOf("sensor_msgs/Image", image).find("has the encoding 'nv12', which is not read: mono8, 8UC1, "),
      0u)
      << refusalOf("sensor_msgs/Image", image);
  EXPECT_EQ(refusalOf("sensor_msgs/CompressedImage", four + "h264" + one + "x"),
            "is neither JPEG nor PNG, but 'h264'");
}

TEST(RosMessages, TypesOfBothGenerationsAreKnown) {
  EXPECT_EQ(rosKindOf("sensor_msgs/Imu"), RosKind::kImu);
  EXPECT_EQ(rosKindOf("sensor_msgs/msg/Imu"), RosKind::kImu);
  EXPECT_EQ(rosKindOf("foxglove_msgs/msg/RawImage"), RosKind::kImage);
  EXPECT_EQ(rosKindOf("sensor_msgs/msg/NavSatFix"), RosKind::kOther);
  EXPECT_EQ(rosKindOf(""), RosKind::kOther);
}

}  // namespace
}  // namespace redbee::test
