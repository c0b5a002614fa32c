// Publishes a node's messages about a frame.
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <type_traits>
#include <utility>

#include "redbee/bus/bus.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

template <typename Message, typename = void>
struct HasSequence : std::false_type {};
template <typename Message>
struct HasSequence<Message, std::void_t<decltype(std::declval<Message&>().sequence)>> : std::true_type {};

/// Whether the type names its publisher.
template <typename Message, typename = void>
struct HasPublisher : std::false_type {};
template <typename Message>
struct HasPublisher<Message, std::void_t<decltype(std::declval<Message&>().publisher)>> : std::true_type {};

class Publisher {
 public:
  explicit Publisher(Bus& bus) : bus_(bus) {}

  /// `time`: of the frame that the following messages are about.
  void beginFrame(CameraTime time) { time_ = time; }
  /// Fills in the frame's time and, if the type has them, the publisher and the sequence number of the
  /// channel.
  template <typename Message>
  void publish(const std::string& channel, Message message) {
    message.utime = toUtime(time_);
    if constexpr (HasPublisher<Message>::value) message.publisher = number_;
    if constexpr (HasSequence<Message>::value) message.sequence = next_sequence_[channel]++;
    bus_.publish(channel, message);
  }
  /// A message that is not about the frame.
  template <typename Message>
  void publishAsIs(const std::string& channel, const Message& message) {
    bus_.publish(channel, message);
  }

 private:
  /// Tells publishers of a channel apart; no result depends on its value.
  static int64_t randomNumber() {
    std::random_device random;
    return static_cast<int64_t>(random()) << 32 | static_cast<int64_t>(random());
  }

  Bus& bus_;
  int64_t number_ = randomNumber();
  CameraTime time_{};
  std::map<std::string, int32_t> next_sequence_;
};

}  // namespace redbee
