#include "redbee/node/stage.hpp"

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

void Stage::finish() {
  finishing_ = true;
  process();
  finishing_ = false;
}

}  // namespace redbee
