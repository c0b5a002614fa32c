// Lengths and CRC_EXTRA of our messages against the table, which a program of its own made from the
// definitions, and against the documented values.
#include <gtest/gtest.h>

#include "redbee/mavlink/attitude_message.hpp"
#include "redbee/mavlink/camera_messages.hpp"
#include "redbee/mavlink/encoder.hpp"
#include "redbee/mavlink/message_table.hpp"
#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/sensor_messages.hpp"
#include "redbee/mavlink/tracking_messages.hpp"
#include "tests/mavlink/vectors.hpp"

namespace redbee::mavlink {
namespace {

template <typename Message>
class MessageLayoutOf : public testing::Test {};
using Ours = testing::Types<Heartbeat, Timesync, CommandLong, CommandInt, CommandAck, CameraInformation,
                            CameraSettings, CameraFovStatus, MountOrientation, GimbalDeviceAttitudeStatus,
                            CameraTrackingImageStatus, CameraTrackingGeoStatus, HighresImu, RawImu,
                            ScaledImu2, Attitude, AttitudeQuaternion, LocalPositionNed, GlobalPositionInt,
                            GpsRawInt, DistanceSensor>;
TYPED_TEST_SUITE(MessageLayoutOf, Ours);

TYPED_TEST(MessageLayoutOf, FollowsFromItsFields) {
  const auto expected = layoutOf(TypeParam::kId);
  ASSERT_TRUE(expected);
  constexpr MessageLayout ours = kLayoutOf<TypeParam>;
  EXPECT_EQ(ours.crc_extra, expected->crc_extra);
  EXPECT_EQ(ours.min_length, expected->min_length);
  EXPECT_EQ(ours.max_length, expected->max_length);
  EXPECT_TRUE(visitedLayout<TypeParam>().isOrdered());
}

TYPED_TEST(MessageLayoutOf, IsReadAsItIsWritten) {
  const TypeParam zero = messageFrom<TypeParam>(nullptr, 0);
  Bytes payload(kLayoutOf<TypeParam>.max_length);
  for (size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<uint8_t>(i + 1);
  EXPECT_EQ(payloadOf(messageFrom<TypeParam>(payload.data(), payload.size())), payload);
  EXPECT_EQ(payloadOf(zero), Bytes(payload.size()));
}

TEST(MessageLayout, HasTheDocumentedCrcExtra) {
  EXPECT_EQ(kLayoutOf<Heartbeat>.crc_extra, 50);
  EXPECT_EQ(kLayoutOf<HighresImu>.crc_extra, 93);
  EXPECT_EQ(kLayoutOf<AttitudeQuaternion>.crc_extra, 246);
  EXPECT_EQ(kLayoutOf<Timesync>.crc_extra, 34);
  EXPECT_FALSE(layoutOf(16'777'215));
}

TEST(MessageLayout, ChecksumIsThatOfItsCatalogueEntry) {
  // CRC-16/MCRF4XX of "123456789".
  EXPECT_EQ(crcOf("123456789", kCrcStart), 0x6f91);
}

TEST(MessageEncoder, WritesTheBytesOfAnother) {
  Encoder ours(1, 191);
  EXPECT_EQ(ours.encode(Heartbeat{0, 18, 8, 0, 4, 3}), vectors::bytesOf(vectors::kOurHeartbeat));
  Encoder theirs(1, 1);
  EXPECT_EQ(theirs.encode(Timesync{0, 1'234'567'890'123, 1, 1}), vectors::bytesOf(vectors::kTimesync));
  EXPECT_EQ(theirs.encode(CommandLong{{105, 5000}, CommandLong::kSetMessageInterval, 1, 1, 0}),
            vectors::bytesOf(vectors::kCommand));
}

}  // namespace
}  // namespace redbee::mavlink
