#include "redbee/node/stage.hpp"

#include <spdlog/spdlog.h>

#include "redbee/bus/image.hpp"

namespace redbee {

Stage::Stage(Bus& bus, const std::string& process, const std::string& configuration_hash)
    : bus_(bus), health_(process, configuration_hash), publisher_(bus) {}

bool Stage::isOfCamera(const image_t& image, cv::Size camera, const std::string& channel) {
  const cv::Size size = declaredSize(image);
  if (size == camera) return true;
  const auto text = [](cv::Size of) { return std::to_string(of.width) + "x" + std::to_string(of.height); };
  health_.noteSkipped();
  health_.noteIgnored(channel, "an image of " + text(size) + " is ignored, configured are " + text(camera));
  return false;
}

void Stage::refuse(const std::string& channel, const char* fault) {
  const std::string what = std::string("a message is refused: ") + fault;
  health_.noteDamaged();
  health_.noteIgnored(channel, what);
  if (refused_.insert(channel + fault).second) spdlog::warn("{}: {}", channel, what);
}

void Stage::finish() {
  finishing_ = true;
  process();
  finishing_ = false;
}

}  // namespace redbee
