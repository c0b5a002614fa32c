// What a stranger on the stack's network does beside the true sensors and processes, by name.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "redbee/fused_homography_t.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/visual_homography_t.hpp"
#include "tests/support/endless_flight.hpp"
#include "tests/support/forgery.hpp"
#include "tests/support/huge_image.hpp"
#include "tests/support/sensor_messages.hpp"

namespace redbee::test {

struct Disturbance {
  std::vector<Subscription> subscriptions;  ///< whose handlers answer with forged messages
  std::function<void()> send;               ///< called about each millisecond, if set
};

namespace disturbance {

constexpr int64_t kHour = 3'600'000'000;

/// The number of the camera's own image; a stranger's is not among them.
inline std::optional<int64_t> ownFrame(const EndlessFlight& flight, const image_t& image) {
  const int64_t frame = flight.frameAt(image.utime);
  const bool is_own =
      image.utime == flight.utime(frame) && frame >= 0 && image.utime < flight.utime(0) + kHour / 2;
  return is_own ? std::optional(frame) : std::nullopt;
}

/// Answers the camera's images with its own: turned by half a turn, `change`d. `change` returns false for an
/// image that is not answered.
inline Subscription answerImages(Bus& bus, const EndlessFlight& flight,
                                 const std::function<bool(int64_t frame, image_t&)>& change) {
  return bus.subscribe<image_t>("CAMERA", 8, [&bus, &flight, change](const image_t& m) {
    const auto frame = ownFrame(flight, m);
    if (!frame) return;
    image_t other = m;
    std::reverse(other.data.begin(), other.data.end());
    if (change(*frame, other)) bus.publish("CAMERA", other);
  });
}

inline Disturbance shiftedCompanions(Bus& bus) {
  constexpr int64_t kAhead = 1'900'000;
  const auto ahead = [](auto& m) {
    m.utime += kAhead;
    m.utime_previous += kAhead;
  };
  Disturbance d;
  d.subscriptions.push_back(forge<inertial_homography_t>(bus, "INERTIAL_HOMOGRAPHY", ahead));
  d.subscriptions.push_back(forge<visual_homography_t>(bus, "VISUAL_HOMOGRAPHY", ahead));
  d.subscriptions.push_back(forge<fused_homography_t>(bus, "FUSED_HOMOGRAPHY", ahead));
  return d;
}

inline Disturbance forgedHomography(Bus& bus) {
  Disturbance d;
  d.subscriptions.push_back(forge<fused_homography_t>(bus, "FUSED_HOMOGRAPHY", [](fused_homography_t& m) {
    m.step.H[2] += 7;
    m.anchor.H[2] += 7;
  }));
  return d;
}

inline Disturbance camera(Bus& bus, const EndlessFlight& flight,
                          const std::function<bool(int64_t, image_t&)>& change) {
  Disturbance d;
  d.subscriptions.push_back(answerImages(bus, flight, change));
  return d;
}

/// A huge image each second.
inline Disturbance hugeImages(Bus& bus, const EndlessFlight& flight) {
  Disturbance d;
  d.subscriptions.push_back(bus.subscribe<image_t>("CAMERA", 8, [&bus, &flight](const image_t& m) {
    const auto frame = ownFrame(flight, m);
    if (!frame || *frame % kFps != 0) return;
    image_t huge = hugeImage();
    huge.utime = m.utime + 20'000;
    bus.publish("CAMERA", huge);
  }));
  return d;
}

inline Disturbance flood(Bus& bus) {
  Disturbance d;
  d.send = [&bus, random = std::make_shared<std::mt19937>(1)] { sendRandomBytes(bus, *random); };
  return d;
}

}  // namespace disturbance

inline Disturbance makeDisturbance(const std::string& name, Bus& bus, const EndlessFlight& flight) {
  using namespace disturbance;
  if (name == "none") return {};
  if (name == "flood") return flood(bus);
  if (name == "forged-homography") return forgedHomography(bus);
  if (name == "shifted-companions") return shiftedCompanions(bus);
  if (name == "huge-images") return hugeImages(bus, flight);
  if (name == "second-camera") {
    return camera(bus, flight, [](int64_t, image_t& m) { return (m.utime += 17'000) > 0; });
  }
  if (name == "camera-an-hour-behind") {
    return camera(bus, flight, [](int64_t, image_t& m) { return (m.utime -= kHour) > 0; });
  }
  if (name == "strays-an-hour-ahead") {
    return camera(bus, flight,
                  [](int64_t frame, image_t& m) { return frame % kFps == 0 && (m.utime += kHour) > 0; });
  }
  throw std::invalid_argument(name + ": no such disturbance");
}

/// Disturbs from a thread and a socket of its own for as long as it lives.
class Stranger {
 public:
  Stranger(std::unique_ptr<Bus> bus, const std::string& name, const EndlessFlight& flight)
      : bus_(std::move(bus)), disturbance_(makeDisturbance(name, *bus_, flight)) {
    thread_ = std::thread([this] {
      while (!over_) {
        bus_->handle(std::chrono::milliseconds(1));
        if (disturbance_.send) disturbance_.send();
      }
    });
  }
  ~Stranger() {
    over_ = true;
    thread_.join();
  }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

 private:
  std::unique_ptr<Bus> bus_;
  Disturbance disturbance_;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

}  // namespace redbee::test
