// What the parallax detector leaves out, rung by rung (adjustable_quality.hpp). A coarser flow, too, would
// save a tenth, and lose a quarter of the objects (EXPERIMENTS.md): frames that are skipped evenly lose less.
#include "redbee/detection/parallax/parallax_detector.hpp"

namespace redbee {
namespace {

constexpr size_t kWithoutPoints = 1;

}  // namespace

std::vector<std::string> ParallaxDetector::rungs() const {
  return uses_points_ ? std::vector<std::string>{"points are not followed"} : std::vector<std::string>{};
}

void ParallaxDetector::setQuality(size_t rung) { evidence_.setQuality(rung); }

void ParallaxEvidence::setQuality(size_t rung) {
  const bool uses_points = rung < kWithoutPoints && configured_.use_point_paths;
  if (uses_points != parameters_.use_point_paths) paths_.reset();
  parameters_.use_point_paths = uses_points;
}

}  // namespace redbee
