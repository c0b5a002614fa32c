#include "redbee/node/stage.hpp"

#include "redbee/geometry/time.hpp"

namespace redbee {

Stage::Stage(Bus& bus, const std::string& process, const std::string& configuration_hash)
    : bus_(bus), health_(process, configuration_hash), publisher_(bus) {}

void Stage::finish() {
  finishing_ = true;
  process();
  finishing_ = false;
}

bool Stage::acceptFrame(int64_t utime) {
  if (!isPlausibleTime(CameraTime(fromUtime(utime)))) {
    health_.noteDamaged();
    return false;
  }
  health_.noteInput(utime);
  const FrameDecision decision = order_.classify(utime);
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
