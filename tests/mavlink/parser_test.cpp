#include "redbee/mavlink/parser.hpp"

#include <gtest/gtest.h>

#include <random>

#include "redbee/mavlink/encoder.hpp"
#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/sensor_messages.hpp"
#include "redbee/mavlink/sequence_loss.hpp"
#include "tests/mavlink/vectors.hpp"

namespace redbee::mavlink {
namespace {

std::vector<Frame> framesIn(Parser& parser, const Bytes& bytes, size_t piece = 1 << 20) {
  std::vector<Frame> frames;
  for (size_t at = 0; at < bytes.size(); at += piece) {
    parser.feed(bytes.data() + at, std::min(piece, bytes.size() - at));
    while (auto frame = parser.next()) frames.push_back(std::move(*frame));
  }
  return frames;
}
Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
Bytes imuFrame() { return vectors::bytesOf(vectors::kImu2); }

void expectTheImu(const Frame& frame) {
  EXPECT_EQ(frame.system, 1);
  EXPECT_EQ(frame.component, 1);
  const auto m = frame.message<HighresImu>();
  EXPECT_EQ(m.time_usec, 123456789U);
  EXPECT_EQ(m.xacc, 0.5F);
  EXPECT_EQ(m.zacc, -9.75F);
  EXPECT_EQ(m.ygyro, -0.0625F);
  EXPECT_EQ(m.abs_pressure, 1013.25F);
  EXPECT_EQ(m.fields_updated, 0xffff);
  EXPECT_EQ(m.id, 0);
}

TEST(MavlinkParser, ReadsBothVersions) {
  Parser parser;
  const auto frames = framesIn(
      parser, imuFrame() + vectors::bytesOf(vectors::kImu1) + vectors::bytesOf(vectors::kHeartbeat1));
  ASSERT_EQ(frames.size(), 3U);
  expectTheImu(frames[0]);
  expectTheImu(frames[1]);
  EXPECT_EQ(frames[0].sequence, 7);
  EXPECT_EQ(frames[1].sequence, 8);
  EXPECT_EQ(frames[2].message<Heartbeat>().autopilot, 12);
  EXPECT_EQ(parser.counters().noise, 0);
}

TEST(MavlinkParser, FillsInTheZerosThatWereLeftOut) {
  Parser parser;
  const auto frames = framesIn(parser, vectors::bytesOf(vectors::kGimbal));
  ASSERT_EQ(frames.size(), 1U);
  const auto m = frames[0].message<GimbalDeviceAttitudeStatus>();
  EXPECT_EQ(m.q[2], -0.5F);
  EXPECT_EQ(m.flags, 32);
  EXPECT_EQ(m.delta_yaw, 1.5F);
  EXPECT_EQ(m.delta_yaw_velocity, 0);
  EXPECT_EQ(m.gimbal_device_id, 0);
}

TEST(MavlinkParser, TakesBytesInPiecesOfAnySize) {
  Bytes stream;
  for (int i = 0; i < 20; ++i) stream = stream + imuFrame() + vectors::bytesOf(vectors::kSignedHeartbeat);
  for (const size_t piece : {1U, 2U, 3U, 7U, 64U, 1000U}) {
    Parser parser;
    EXPECT_EQ(framesIn(parser, stream, piece).size(), 40U) << piece;
    EXPECT_EQ(parser.counters().noise, 0);
  }
}

// Whatever byte is wrong, and whatever it becomes, that frame is lost and no other: also where the length
// grows.
TEST(MavlinkParser, AWrongByteCostsItsFrameAlone) {
  const Bytes good = imuFrame();
  for (size_t at = 0; at < good.size(); ++at) {
    for (const int flip : {1, 0x80, 0xff}) {
      Bytes bad = good;
      bad[at] = static_cast<uint8_t>(bad[at] ^ flip);
      Parser parser;
      // Enough good frames behind it for the longest length that the damage may announce.
      const auto frames = framesIn(parser, good + bad + good + good + good + good + good);
      EXPECT_EQ(frames.size(), 6U) << "byte " << at;
      for (const Frame& frame : frames) expectTheImu(frame);
    }
  }
}

TEST(MavlinkParser, AWrongPayloadIsOneError) {
  Bytes bad = imuFrame();
  bad[20] ^= 4;
  Parser parser;
  EXPECT_EQ(framesIn(parser, bad + imuFrame()).size(), 1U);
  EXPECT_EQ(parser.counters().crc_errors, 1);
  EXPECT_EQ(parser.counters().noise, static_cast<int64_t>(bad.size()));
}

TEST(MavlinkParser, AMissingByteCostsItsFrameAlone) {
  const Bytes good = imuFrame();
  for (size_t at = 0; at < good.size(); ++at) {
    Bytes bad = good;
    bad.erase(bad.begin() + static_cast<std::ptrdiff_t>(at));
    Parser parser;
    EXPECT_EQ(framesIn(parser, good + bad + good + good + good + good + good).size(), 6U) << "byte " << at;
  }
}

TEST(MavlinkParser, NoiseHoldsNoFrames) {
  std::mt19937 random(1);
  Bytes noise(200'000);
  for (uint8_t& byte : noise) byte = static_cast<uint8_t>(random());
  Parser parser;
  // A frame of noise passes its checksum once in 65536; some 1500 magics are in it, most of an unknown
  // message.
  EXPECT_LE(framesIn(parser, noise).size(), 1U);
  EXPECT_GT(parser.counters().crc_errors, 0);
}

TEST(MavlinkParser, FindsTheFramesBetweenNoise) {
  std::mt19937 random(2);
  Bytes stream;
  for (int i = 0; i < 300; ++i) {
    stream = stream + imuFrame();
    for (auto bytes = random() % 40; bytes > 0; --bytes) stream.push_back(static_cast<uint8_t>(random()));
  }
  Parser parser;
  parser.feed(stream.data(), stream.size());
  parser.endOfDatagram();
  int found = 0;
  while (const auto frame = parser.next()) found += frame->id == HighresImu::kId ? 1 : 0;
  EXPECT_EQ(found, 300);
}

TEST(MavlinkParser, AFrameDoesNotGoOnInTheNextDatagram) {
  const Bytes good = imuFrame();
  Parser parser;
  parser.feed(good.data(), good.size() - 1);
  parser.endOfDatagram();
  EXPECT_FALSE(parser.next());
  EXPECT_EQ(framesIn(parser, good).size(), 1U);
}

TEST(MavlinkParser, RefusesFlagsThatItDoesNotUnderstand) {
  Bytes frame = vectors::bytesOf(vectors::kHeartbeat2);
  frame[2] = 0x02;
  const uint16_t crc =
      crcOf(kLayoutOf<Heartbeat>.crc_extra, crcOf(frame.data() + 1, frame.size() - 3, kCrcStart));
  frame[frame.size() - 2] = static_cast<uint8_t>(crc);
  frame[frame.size() - 1] = static_cast<uint8_t>(crc >> 8);
  Parser parser;
  EXPECT_TRUE(framesIn(parser, frame + imuFrame()).size() == 1);
  EXPECT_EQ(parser.counters().unknown, 1);
}

TEST(MavlinkSequence, CountsWhatIsMissing) {
  SequenceLoss loss;
  const auto note = [&](uint8_t sequence, uint8_t component = 1) {
    Frame frame;
    frame.sequence = sequence;
    frame.component = component;
    loss.note(frame);
  };
  for (const int sequence : {250, 251, 254, 255, 0, 3}) note(static_cast<uint8_t>(sequence));
  EXPECT_EQ(loss.lost(), 4);  // 252 253, 1 2
  note(9, 2);                 // another sender's first
  note(10, 2);
  EXPECT_EQ(loss.lost(), 4);
  note(1);  // overtaken, or a restart
  EXPECT_EQ(loss.lost(), 4);
  note(2);
  EXPECT_EQ(loss.lost(), 4);
}

}  // namespace
}  // namespace redbee::mavlink
