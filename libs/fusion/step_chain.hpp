// The latest frames and the steps between them, so that a source that skipped frames still gives an estimate
// of the newest step.
#pragma once

#include <deque>
#include <optional>

#include "redbee/fusion/estimate.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

/// Unbroken: each frame's step begins at the frame before. Bounded.
class StepChain {
 public:
  bool empty() const { return frames_.empty(); }
  /// Precondition: not empty.
  CameraTime newest() const { return frames_.back().time; }
  /// The frame before the newest one; the newest one where there is no other. Precondition: not empty.
  CameraTime secondNewest() const { return frames_[frames_.size() > 1 ? frames_.size() - 2 : 0].time; }

  /// Erases all others.
  void beginAt(CameraTime time) { frames_.assign(1, {time, identityEstimate()}); }
  void append(CameraTime time, const Estimate& step);

  /// `since`: from the frame at `time` to one that follows the newest. The part of it after the newest frame;
  /// std::nullopt if `time` is not a frame of this chain.
  std::optional<Estimate> stepOf(CameraTime time, const Estimate& since) const;

 private:
  struct Frame {
    CameraTime time;
    Estimate step;  ///< from the frame before
  };
  std::deque<Frame> frames_;
};

}  // namespace redbee
