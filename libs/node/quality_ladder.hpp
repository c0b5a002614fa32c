// Which elements a stage leaves out while it is slower than the camera: rungs, down where a backlog grows, up
// again where there has been none for long.
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
    ++since_change_;
    calm_ = kCalm * backlog <= longest ? calm_ + 1 : 0;
    if (kFall * backlog > longest && since_change_ >= kSettling && rung_ < lowest_) {
      // What has just been taken back up was too much, and is tried more rarely.
      patience_ = rose_ && since_change_ < std::max(patience_, kTrial)
                      ? std::min(2 * patience_, kMostPatience)
                      : kPatience;
      changeTo(rung_ + 1, false);
    } else if (calm_ >= patience_ && since_change_ >= patience_ && rung_ > 0) {
      changeTo(rung_ - 1, true);
    }
    return rung_;
  }
  size_t rung() const { return rung_; }

 private:
  static constexpr int kFall = 3;       // down beyond this part of the longest backlog
  static constexpr int kCalm = 9;       // up below this one
  static constexpr int kSettling = 6;   // frames: before them a change has not shown yet
  static constexpr int kPatience = 48;  // frames without a backlog
  static constexpr int kTrial = 768;    // frames: what is too much by 1 % has shown by then
  static constexpr int kMostPatience = 1536;

  void changeTo(size_t rung, bool rose) {
    rung_ = rung;
    rose_ = rose;
    since_change_ = calm_ = 0;
  }

  size_t lowest_;
  size_t rung_ = 0;
  bool rose_ = false;  ///< by the last change
  int since_change_ = kSettling;
  int calm_ = 0;  ///< frames in a row
  int patience_ = kPatience;
};

}  // namespace redbee
