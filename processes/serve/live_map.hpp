// The live map: renewed by POSE and TARGETS as well as by frames, but not more often than is seen.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "processes/serve/map_view.hpp"

namespace redbee {

class LiveMap {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kPeriod{100};

  explicit LiveMap(const Configuration& configuration);

  void onPose(const pose_t& pose);
  void onTargets(const targets_t& targets);
  void onFused(const fused_homography_t& fused) { map_.onFused(fused); }
  /// An image or what was detected in it, us, camera clock.
  void onFrame(int64_t utime, Time now);

  /// Whoever looks has seen none: the next is due though nothing is new.
  void renew();
  /// JSON, see mapJson(); std::nullopt where nothing is new, or the last is younger than kPeriod.
  std::optional<std::string> takeText(Time now);

 private:
  int64_t utimeAt(Time now) const;

  MapBuilder map_;
  bool expects_targets_;
  std::string targets_channel_;
  int64_t timeshift_us_;
  int64_t pose_utime_ = 0;
  int64_t frame_utime_ = 0;
  Time frame_arrival_;
  Time next_;
  bool is_new_ = false;
};

}  // namespace redbee
