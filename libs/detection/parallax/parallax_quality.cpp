// What the parallax detector leaves out (adjustable_quality.hpp). Without a coarser flow, or without
// candidates, too, it would save more, and lose more than frames that are skipped evenly (EXPERIMENTS.md).
#include "redbee/detection/parallax/parallax_detector.hpp"

namespace redbee {

std::vector<std::string> ParallaxDetector::rungs() const { return evidence_.rungs(); }
void ParallaxDetector::setQuality(size_t rung) { evidence_.setQuality(rung); }

std::vector<std::string> ForegroundEvidence::rungs() const {
  const bool fills = appearance_.enabled && (parallax_.use_hole_filling || parallax_.region_radius_px > 0);
  std::string left_out = fills ? "regions are not filled" : "";
  if (parallax_.use_point_paths) left_out += fills ? ", points are not followed" : "points are not followed";
  return left_out.empty() ? std::vector<std::string>() : std::vector<std::string>{left_out};
}

void ForegroundEvidence::setQuality(size_t rung) {
  is_complete_ = rung == 0;
  motion_.followPoints(is_complete_);
}

}  // namespace redbee
