// What the parallax detector leaves out, rung by rung (adjustable_quality.hpp).
#include <algorithm>

#include "redbee/detection/parallax/parallax_detector.hpp"

namespace redbee {
namespace {

constexpr size_t kWithoutPoints = 1, kCoarserFlow = 2;

}  // namespace

std::vector<std::string> ParallaxDetector::rungs() const {
  return {"points are not followed", "the flow is coarser"};
}

void ParallaxDetector::setQuality(size_t rung) { evidence_.setQuality(rung); }

void ParallaxEvidence::setQuality(size_t rung) {
  const bool uses_points = rung < kWithoutPoints && configured_.use_point_paths;
  if (uses_points != parameters_.use_point_paths) paths_.reset();
  parameters_.use_point_paths = uses_points;
  ParallaxParameters wanted = configured_;
  const EarlierFrame* newest = frames_.newest();
  constexpr int kPatches = 4;  // of the coarser flow, along the shorter side, at least
  if (rung >= kCoarserFlow && newest != nullptr) {
    const int coarser = 2 * std::max(wanted.flow_downscale, wanted.work_downscale);
    const int side = kSearchPatch_px * coarser / std::max(wanted.work_downscale, 1);
    if (std::min(newest->grey.cols, newest->grey.rows) >= kPatches * side) wanted.flow_downscale = coarser;
  }
  InverseSearch search = makeMotionFlow(wanted);
  if (search.patch() != search_.patch()) search_ = std::move(search);
}

}  // namespace redbee
