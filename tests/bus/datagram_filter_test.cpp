#include "redbee/bus/datagram_filter.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "redbee/bus/codec.hpp"
#include "tests/bus/sample_messages.hpp"

namespace redbee::test {
namespace {

std::string number(uint32_t value, int bytes) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xff);
  return text;
}
/// LCM's datagrams: a whole message, and one of several that a long message goes in.
std::string whole(const std::string& channel, const std::string& data = "12345678") {
  return "LC02" + number(7, 4) + channel + '\0' + data;
}
std::string fragment(const std::string& channel, uint32_t message_size, uint32_t index) {
  const std::string head = "LC03" + number(7, 4) + number(message_size, 4) + number(100 * index, 4) +
                           number(index, 2) + number(3, 2);
  return head + (index == 0 ? channel + '\0' : "") + "data";
}

class DatagramFilter : public testing::Test {
 protected:
  void SetUp() override {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address_;
    if (bind(receiver_, raw(), length) != 0) GTEST_SKIP() << "no loopback here";
    getsockname(receiver_, raw(), &length);
  }
  void TearDown() override {
    close(receiver_);
    close(sender_);
  }
  bool passes(const std::string& datagram) {
    sendto(sender_, datagram.data(), datagram.size(), 0, raw(), sizeof address_);
    char into[256];
    const ssize_t size = recv(receiver_, into, sizeof into, MSG_DONTWAIT);
    return size >= 0 && std::string(into, static_cast<size_t>(size)) == datagram;
  }
  sockaddr* raw() { return reinterpret_cast<sockaddr*>(&address_); }

  int receiver_ = socket(AF_INET, SOCK_DGRAM, 0);
  int sender_ = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address_{};
};

TEST_F(DatagramFilter, KeepsWhatIsWantedByItsWholeName) {
  ASSERT_TRUE(receiveOnly(receiver_, {{"POSE", true}, {"DETECTIONS", true}, {"GIMBALS", true}, {"A", true}}));
  for (const char* channel : {"POSE", "DETECTIONS", "GIMBALS", "A"}) {
    EXPECT_TRUE(passes(whole(channel))) << channel;
    EXPECT_TRUE(passes(fragment(channel, 70'000, 0))) << channel;
  }
  for (const char* channel : {"POS", "POSES", "POSE2", "pose", "IMU", "", "DETECTION", "GIMBAL", "B", "AA"}) {
    EXPECT_FALSE(passes(whole(channel))) << channel;
    EXPECT_FALSE(passes(fragment(channel, 70'000, 0))) << channel;
  }
}

TEST_F(DatagramFilter, KeepsAShortDatagramBehindALongName) {
  ASSERT_TRUE(receiveOnly(receiver_, {{"A_NAME_THAT_IS_LONGER_THAN_THE_DATAGRAM", true}, {"A", true}}));
  EXPECT_TRUE(passes(whole("A", "")));
  EXPECT_FALSE(passes(whole("B", "")));
}

TEST_F(DatagramFilter, DropsTheRestOfLongMessagesWhereAllThatIsWantedIsShort) {
  ASSERT_TRUE(receiveOnly(receiver_, {{"POSE", true}}));
  EXPECT_FALSE(passes(fragment("", kShortMessage + 1, 1)));
  EXPECT_TRUE(passes(fragment("", kShortMessage, 1)));
  ASSERT_TRUE(receiveOnly(receiver_, {{"POSE", true}, {"CAMERA", false}}));
  EXPECT_TRUE(passes(fragment("", 0xffffffff, 1)));
  EXPECT_TRUE(passes(fragment("CAMERA", 300'000, 0)));
  ASSERT_TRUE(receiveOnly(receiver_, {{"POSE", true}}));
  EXPECT_FALSE(passes(fragment("CAMERA", 300'000, 0)));
  EXPECT_TRUE(passes(whole("POSE")));
}

TEST_F(DatagramFilter, LeavesWhatIsNotOfLcmToLcm) {
  ASSERT_TRUE(receiveOnly(receiver_, {{"POSE", true}}));
  EXPECT_TRUE(passes("LC01 or whatever comes after LC03"));
}

TEST_F(DatagramFilter, KeepsNothingWhereNothingIsWantedAndAllWhereItIsTooMuch) {
  ASSERT_TRUE(receiveOnly(receiver_, {}));
  EXPECT_FALSE(passes(whole("POSE")));
  EXPECT_FALSE(receiveOnly(receiver_, std::vector<WantedChannel>(1000, {"POSE", true})));
  EXPECT_TRUE(passes(whole("IMU")));
}

TEST_F(DatagramFilter, TheLongestNameIsCompared) {
  const std::string longest(63, 'x');
  ASSERT_TRUE(receiveOnly(receiver_, {{longest, true}}));
  EXPECT_TRUE(passes(whole(longest)));
  EXPECT_FALSE(passes(whole(longest.substr(1) + "y")));
}

TEST_F(DatagramFilter, WhatTheKernelHasNoMemoryForKeepsAll) {
  std::vector<WantedChannel> wanted;
  bool is_filtered = true;
  for (int i = 0; i < 64 && is_filtered; ++i) {
    wanted.push_back({std::string(60, 'x') + std::to_string(100 + i), true});
    is_filtered = receiveOnly(receiver_, wanted);
    EXPECT_TRUE(passes(whole(wanted.back().name))) << "channel " << i;
  }
  EXPECT_EQ(passes(whole("ANOTHER")), !is_filtered);
}

TEST_F(DatagramFilter, FindsTheSocketsOfUdpAlone) {
  const int other = socket(AF_UNIX, SOCK_DGRAM, 0);
  const std::set<int> found = udpSockets();
  EXPECT_EQ(found.count(receiver_), 1U);
  EXPECT_EQ(found.count(sender_), 1U);
  EXPECT_EQ(found.count(other), 0U);
  EXPECT_EQ(found.count(0), 0U);
  close(other);
}

TEST(MessageLength, ShortMessagesHaveRoomForAllThatIsPlausible) {
  detections_t detections{};
  detections.n = 1 << 12;  // message_limits::kMaxDetections
  detections.detections.resize(static_cast<size_t>(detections.n));
  EXPECT_LE(encodeMessage(detections).size(), kShortMessage);
  targets_t targets{};
  targets.n = 1 << 10;  // message_limits::kMaxTargets
  targets.targets.resize(static_cast<size_t>(targets.n));
  EXPECT_LE(encodeMessage(targets).size(), kShortMessage);
}

}  // namespace
}  // namespace redbee::test
