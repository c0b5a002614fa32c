// Publishes a node's messages about a frame.
#pragma once

#include <cstdint>
#include <map>
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

class Publisher {
 public:
  explicit Publisher(Bus& bus) : bus_(bus) {}

  /// `time`: of the frame that the following messages are about.
  void beginFrame(CameraTime time) { time_ = time; }
  /// Fills in the frame's time and, if the type has one, the sequence number of the channel.
  template <typename Message>
  void publish(const std::string& channel, Message message) {
    message.utime = toUtime(time_);
    if constexpr (HasSequence<Message>::value) message.sequence = next_sequence_[channel]++;
    bus_.publish(channel, message);
  }
  /// A message that is not about the frame.
  template <typename Message>
  void publishAsIs(const std::string& channel, const Message& message) {
    bus_.publish(channel, message);
  }

 private:
  Bus& bus_;
  CameraTime time_{};
  std::map<std::string, int32_t> next_sequence_;
};

}  // namespace redbee
