// What every reader of messages refuses: each member of true messages damaged in turn, and messages of random
// content.
#include "redbee/node/message_check.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "tests/support/true_messages.hpp"

namespace redbee::test {
namespace {

/// Sets the n-th number that `Kind` selects to a value.
template <template <typename> class Kind>
class SingleDamage {
 public:
  SingleDamage(int at, double real) : at_(at), real_(real) {}

  template <typename Number>
  void value(Number& number) {
    if constexpr (Kind<Number>::value) {
      if (seen_++ != at_) return;
      if constexpr (std::is_floating_point_v<Number>) {
        number = static_cast<Number>(real_);
      } else {
        number = std::numeric_limits<Number>::lowest();
      }
    }
  }
  void value(std::string&) {}
  void count(int32_t&) {}
  template <typename Array>
  void resize(Array&, int32_t) {}
  bool isDone() const { return seen_ <= at_; }

 private:
  int at_;
  double real_;
  int seen_ = 0;
};

template <typename Number>
struct IsSigned : std::bool_constant<std::is_integral_v<Number> && std::is_signed_v<Number>> {};

/// How many single damages of the kind a message of the type passes with.
template <typename Message, template <typename> class Kind>
int passedWith(double real) {
  int passed = 0;
  for (int at = 0;; ++at) {
    Message message = trueMessages().get<Message>();
    SingleDamage<Kind> damage(at, real);
    WireShape<Message>::visit(message, damage);
    if (damage.isDone()) return passed;
    passed += isPlausible(message) ? 1 : 0;
  }
}

template <typename Message>
struct Unread {
  static constexpr int kReals = 0;
  static constexpr int kIntegers = 0;
};
template <>
struct Unread<ins_t> {  // mag, quat, pressure, rel_alt; device_time
  static constexpr int kReals = 9;
  static constexpr int kIntegers = 1;
};
template <>
struct Unread<image_t> {  // row_stride, pixelformat: the decoder's
  static constexpr int kReals = 0;
  static constexpr int kIntegers = 2;
};
/// The publisher's number is random.
struct RandomNumber {
  static constexpr int kReals = 0;
  static constexpr int kIntegers = 1;
};
template <>
struct Unread<inertial_homography_t> : RandomNumber {};
template <>
struct Unread<visual_homography_t> : RandomNumber {};
template <>
struct Unread<fused_homography_t> : RandomNumber {};

/// Random bits in every member, counts up to three.
class RandomVisitor {
 public:
  explicit RandomVisitor(std::mt19937& random) : random_(random) {}

  template <typename Number>
  void value(Number& number) {
    const uint64_t bits = uint64_t{random_()} << 32 | random_();
    std::memcpy(&number, &bits, sizeof number);
  }
  void value(std::string& text) { text = std::string(random_() % 8, 'x'); }
  void count(int32_t& n) { n = static_cast<int32_t>(random_() % 4); }
  template <typename Array>
  void resize(Array& array, int32_t n) {
    array.resize(static_cast<size_t>(n));
  }

 private:
  std::mt19937& random_;
};
template <typename Message>
Message randomMessage(std::mt19937& random) {
  Message message{};
  RandomVisitor visitor(random);
  WireShape<Message>::visit(message, visitor);
  return message;
}

template <typename Message>
class MessageCheck : public testing::Test {};
using SentTypes = testing::Types<altimeter_t, clock_offset_t, detections_t, gimbal_t, lens_t, pose_t,
                                 targets_t, filter_snapshot_t, foreground_t, fused_homography_t, image_t,
                                 inertial_homography_t, ins_t, process_health_t, visual_homography_t>;
TYPED_TEST_SUITE(MessageCheck, SentTypes);

TYPED_TEST(MessageCheck, TrueMessagesPass) {
  EXPECT_STREQ(faultOf(trueMessages().get<TypeParam>()), nullptr);
}

TYPED_TEST(MessageCheck, NoMemberMayBeWithoutSense) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double senseless : {std::nan(""), infinity, -infinity, 1e30, -1e30}) {
    EXPECT_EQ((passedWith<TypeParam, std::is_floating_point>(senseless)), Unread<TypeParam>::kReals)
        << senseless;
  }
  EXPECT_EQ((passedWith<TypeParam, IsSigned>(0)), Unread<TypeParam>::kIntegers);
}

/// As between two lenses, wide and narrow, of which either may be the configured one; 0: not known.
template <typename Message>
void expectBoundsOfZoom() {
  Message message = trueMessages().get<Message>();
  for (const double zoom : {0.0, 0.01, 1.0, 100.0}) {
    message.zoom = zoom;
    EXPECT_TRUE(isPlausible(message)) << zoom;
  }
  for (const double zoom : {-1.0, 0.0099, 1e-30, 100.1}) {
    message.zoom = zoom;
    EXPECT_FALSE(isPlausible(message)) << zoom;
  }
}

TEST(MessageChecks, AZoomHasTwoBounds) {
  expectBoundsOfZoom<inertial_homography_t>();
  expectBoundsOfZoom<visual_homography_t>();
  expectBoundsOfZoom<fused_homography_t>();
}

TYPED_TEST(MessageCheck, RandomContentIsRefused) {
  std::mt19937 random(1);
  int passed = 0;
  for (int i = 0; i < 1000; ++i) passed += isPlausible(randomMessage<TypeParam>(random)) ? 1 : 0;
  // Few numbers can be true by chance: 6 % of an altimeter's, 2 % of an IMU's.
  EXPECT_LE(passed, 100);
}

TEST(MessageChecks, AWholeFlightPasses) {
  const StackOutput& output = trueMessages().output;
  const auto expect_all = [](const auto& messages) {
    for (const auto& [key, message] : messages) EXPECT_STREQ(faultOf(message), nullptr);
  };
  expect_all(output.inertial);
  expect_all(output.visual);
  expect_all(output.fused);
  expect_all(output.foreground);
  expect_all(output.detections);
  expect_all(output.health);
  for (const auto& [name, health] : output.health) EXPECT_EQ(health.damaged, 0) << name;
}

TEST(MessageChecks, ARefusedMessageIsCountedAndNamed) {
  bool damaged = false;
  const StackFlight flight = withChanged<altimeter_t>(undisturbedFlight(), "ALTIMETER", [&](altimeter_t& m) {
    if (!std::exchange(damaged, true)) m.height = 1e20;
  });
  const auto bus = makeLcmBus("memq://");
  const Subscription subscription =
      bus->subscribe<process_health_t>("PROCESS_HEALTH", 64, [](const auto&) {});
  StackOutput output;
  const std::vector<Subscription> subscriptions = output.subscribe(*bus);
  InProcessStack stack(*bus, flight.configuration);
  for (const SensorMessage& sent : flight.messages) {
    if (sent.utime > endTime(flight)) break;
    bus->publish(sent.channel, sent.data);
    stack.settle();
  }
  stack.publishHealth();
  const process_health_t& health = output.health.at("redbee-imu-integration");
  EXPECT_EQ(health.damaged, 1);
  EXPECT_EQ(health.state, process_health_t::DEGRADED);
  EXPECT_NE(health.message.find("ALTIMETER: a message is refused: height"), std::string::npos)
      << health.message;
}

/// Beside each image one message of random content on each channel.
TEST(MessageChecks, RandomContentIsHarmless) {
  StackFlight flight = undisturbedFlight();
  const Channels& c = flight.configuration.channels;
  std::mt19937 random(2);
  std::vector<SensorMessage> with_random;
  const auto add = [&](const std::string& channel, auto message, int64_t utime) {
    with_random.push_back({utime, channel, encodeMessage(message)});
  };
  for (const SensorMessage& sent : flight.messages) {
    with_random.push_back(sent);
    if (!isDisturbed(flight, sent.utime) || sent.channel != c.camera) continue;
    add(c.camera, randomMessage<image_t>(random), sent.utime);
    add(c.imu, randomMessage<ins_t>(random), sent.utime);
    add(c.altimeter, randomMessage<altimeter_t>(random), sent.utime);
    add(c.inertial_homography, randomMessage<inertial_homography_t>(random), sent.utime);
    add(c.visual_homography, randomMessage<visual_homography_t>(random), sent.utime);
    add(c.fused_homography, randomMessage<fused_homography_t>(random), sent.utime);
    add(c.filter_snapshot, randomMessage<filter_snapshot_t>(random), sent.utime);
    add(c.warm_start, randomMessage<filter_snapshot_t>(random), sent.utime);
    add(c.health, randomMessage<process_health_t>(random), sent.utime);
    add(c.detections, randomMessage<detections_t>(random), sent.utime);
    add(c.foreground, randomMessage<foreground_t>(random), sent.utime);
  }
  flight.messages = with_random;
  const auto bus = makeLcmBus("memq://");
  const StackOutput output = StackRun(flight, *bus).run();
  EXPECT_EQ(bus->handlerFailures(), 0);
  const Damage damage = expectRecovery("messages of random content", output, flight, 1);
  EXPECT_LT(damage.worst_px, 0.1);
  EXPECT_EQ(damage.without_mask, 0);
}

}  // namespace
}  // namespace redbee::test
