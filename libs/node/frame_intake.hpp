// What every node does with the time of a frame that arrives.
#pragma once

#include "redbee/geometry/time.hpp"
#include "redbee/node/frame_order.hpp"
#include "redbee/node/health.hpp"

namespace redbee {

/// True for a frame to work on. `restart` is called first where the camera's clock was set back.
template <typename Restart>
bool acceptFrame(FrameOrder& order, HealthMonitor& health, int64_t utime, const Restart& restart) {
  if (!isPlausibleTime(CameraTime(fromUtime(utime)))) {
    health.noteDamaged();
    return false;
  }
  health.noteInput(utime);
  const auto verdict = order.classify(utime);
  if (verdict == FrameDecision::kDiscard) {
    health.noteSkipped();
    return false;
  }
  if (verdict == FrameDecision::kRestart) {
    restart();
    health.setState(HealthState::kDegraded, "the camera's clock was set back: started anew");
  }
  return true;
}

}  // namespace redbee
