// The latest frames and the steps between them, so that a source that skipped frames still gives an estimate
// of the newest step.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "redbee/fusion/estimate.hpp"

namespace redbee {

/// Unbroken: each frame's step begins at the frame before. Bounded.
class StepChain {
 public:
  bool empty() const { return frames_.empty(); }
  /// Precondition: not empty.
  int64_t newest() const { return frames_.back().utime; }
  /// The frame before the newest one; the newest one where there is no other. Precondition: not empty.
  int64_t secondNewest() const { return frames_[frames_.size() > 1 ? frames_.size() - 2 : 0].utime; }

  /// Erases all others.
  void beginAt(int64_t utime) { frames_.assign(1, {utime, identityEstimate()}); }
  void append(int64_t utime, const Estimate& step);

  /// `since`: from the frame at `utime` to one that follows the newest. The part of it after the newest
  /// frame; nothing where `utime` is not a frame of this chain.
  std::optional<Estimate> stepOf(int64_t utime, const Estimate& since) const;

 private:
  struct Frame {
    int64_t utime;
    Estimate step;  ///< from the frame before
  };
  std::deque<Frame> frames_;
};

}  // namespace redbee
