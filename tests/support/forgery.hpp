// Messages in another's name.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"

namespace redbee::test {

template <typename Message, typename = void>
struct HasPublisher : std::false_type {};
template <typename Message>
struct HasPublisher<Message, std::void_t<decltype(std::declval<Message&>().publisher)>> : std::true_type {};

template <typename Message>
void signAs(Message& message, int64_t publisher) {
  if constexpr (HasPublisher<Message>::value) message.publisher = publisher;
}

/// Answers each message of a channel with a forged copy, from another publisher.
template <typename Message>
Subscription forge(Bus& bus, const std::string& channel, const std::function<void(Message&)>& change) {
  constexpr int32_t kMarked = 1'000'000;
  return bus.subscribe<Message>(channel, 64, [&bus, channel, change](const Message& m) {
    if (m.sequence >= kMarked) return;
    Message forged = m;
    forged.sequence += kMarked;
    signAs(forged, 4711);
    change(forged);
    bus.publish(channel, forged);
  });
}

/// Random bytes, at most 3000, once on every channel of the stack. Returns how many messages that were.
inline int sendRandomBytes(Bus& bus, std::mt19937& random) {
  const Channels channels;
  const std::vector<std::string> all = {
      channels.camera,           channels.imu,   channels.inertial_homography, channels.visual_homography,
      channels.fused_homography, channels.health};
  for (const std::string& channel : all) {
    std::vector<uint8_t> data(1 + random() % 3000);
    for (uint8_t& byte : data) byte = static_cast<uint8_t>(random());
    bus.publish(channel, data);
  }
  return static_cast<int>(all.size());
}

}  // namespace redbee::test
