// Which elements a stage leaves out while it is slower than the camera: rungs, down where a backlog grows, up
// again where there has been hardly any for long.
#pragma once

#include <algorithm>
#include <cstddef>

#include "redbee/geometry/time.hpp"

namespace redbee {

/// By message times alone.
class QualityLadder {
 public:
  /// Rungs 0 (everything) to `lowest`.
  explicit QualityLadder(size_t lowest) : lowest_(lowest) {}

  /// The rung for a frame. `backlog`: how much older than the newest frame it is, as far as this stage is the
  /// reason; `longest`: at which frames are skipped.
  size_t update(Duration backlog, Duration longest) {
    const bool is_calm = kCalm * backlog <= longest;
    ++since_change_;
    calm_since_change_ += is_calm ? 1 : 0;
    calm_ = std::max(0, calm_ + (is_calm ? 1 : -kBacklogWeight));
    if (kFall * backlog > longest && since_change_ >= kSettling && rung_ < lowest_) {
      learnFromTrial();
      changeTo(rung_ + 1, false);
    } else if (calm_ >= patience_ && rung_ > 0) {
      changeTo(rung_ - 1, true);
    }
    return rung_;
  }
  size_t rung() const { return rung_; }

 private:
  static constexpr int kFall = 3;      // down beyond this part of the longest backlog
  static constexpr int kCalm = 9;      // up below this one
  static constexpr int kSettling = 6;  // frames: before them a change has not shown yet
  // A rung is taken back up where more than three of four frames have no backlog: what disturbs the flight
  // every few seconds does not keep it down.
  static constexpr int kBacklogWeight = 3;
  static constexpr int kPatience = 48;  // frames without a backlog, less those with one, weighted
  static constexpr int kTrial = 768;    // frames: what is too much by 1 % has shown by then
  static constexpr int kMostPatience = 1536;

  /// What has just been taken back up, and was too much, is tried more rarely. The backlog of a rung that is
  /// too slow grows evenly, and is calm for kFall / kCalm of its time; where it leapt from calm, something
  /// else disturbed the stage, which says nothing about the rung.
  void learnFromTrial() {
    if (!rose_ || since_change_ >= std::max(patience_, kTrial)) {
      patience_ = kPatience;
    } else if (calm_since_change_ > kBacklogWeight * (since_change_ - calm_since_change_)) {
      patience_ = std::max(patience_ / 2, kPatience);
    } else {
      patience_ = std::min(2 * patience_, kMostPatience);
    }
  }

  void changeTo(size_t rung, bool rose) {
    rung_ = rung;
    rose_ = rose;
    since_change_ = calm_since_change_ = calm_ = 0;
  }

  size_t lowest_;
  size_t rung_ = 0;
  bool rose_ = false;  ///< by the last change
  int since_change_ = kSettling;
  int calm_since_change_ = 0;  ///< frames without a backlog
  int calm_ = 0;               ///< such frames, less those with one, weighted
  int patience_ = kPatience;
};

}  // namespace redbee
