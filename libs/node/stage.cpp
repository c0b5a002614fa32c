#include "redbee/node/stage.hpp"

namespace redbee {

Stage::Stage(Bus& bus, const std::string& process, const std::string& configuration_hash)
    : bus_(bus), health_(process, configuration_hash), publisher_(bus) {}

void Stage::finish() {
  finishing_ = true;
  process();
  finishing_ = false;
}

}  // namespace redbee
