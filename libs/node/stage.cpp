#include "redbee/node/stage.hpp"

namespace redbee {

Stage::Stage(Bus& bus, const std::string& process, const std::string& configuration_hash)
    : bus_(bus), health_(process, configuration_hash), publisher_(bus) {}

void Stage::finish() {
  finishing_ = true;
  process();
  finishing_ = false;
}

bool Stage::acceptFrame(CameraTime time) {
  if (!isPlausibleTime(time)) {
    health_.noteDamaged();
    return false;
  }
  health_.noteInput(time.time_since_epoch());
  const FrameDecision decision = order_.classify(time);
  if (decision == FrameDecision::kDiscard) {
    health_.noteSkipped();
    return false;
  }
  if (decision == FrameDecision::kRestart) {
    restart();
    health_.setState(HealthState::kDegraded, "the camera's clock was set back: restarted");
  }
  return true;
}

}  // namespace redbee
