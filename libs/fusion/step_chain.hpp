// Buffer of the latest frames and the steps between them, so that a source that skipped frames still gives an
// estimate of the newest step.
#pragma once

#include <deque>
#include <optional>

#include "redbee/fusion/estimate.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

/// Each frame's step starts at the previous frame. The length is bounded.
class StepChain {
 public:
  bool empty() const { return frames_.empty(); }
  /// Precondition: not empty.
  CameraTime newest() const { return frames_.back().time; }
  /// The frame before the newest; the newest if it is the only one. Precondition: not empty.
  CameraTime secondNewest() const { return frames_[frames_.size() > 1 ? frames_.size() - 2 : 0].time; }

  /// Erases all frames and starts with this one.
  void beginAt(CameraTime time) { frames_.assign(1, {time, identityEstimate()}); }
  void append(CameraTime time, const Estimate& step);

  /// `since`: from the frame at `time` to the frame that follows the newest one. Returns its part after the
  /// newest frame; std::nullopt if `time` is not in this chain.
  std::optional<Estimate> stepOf(CameraTime time, const Estimate& since) const;
  /// From the frame at `time` to the newest one; std::nullopt if `time` is not in this chain.
  std::optional<Estimate> since(CameraTime time) const;

 private:
  struct Frame {
    CameraTime time;
    Estimate step;  ///< from the previous frame
  };
  std::deque<Frame> frames_;
};

}  // namespace redbee
