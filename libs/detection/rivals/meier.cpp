#include "redbee/detection/rivals/meier.hpp"

#include <opencv2/core/eigen.hpp>

#include "redbee/detection/rivals/ego_motion.hpp"
#include "redbee/detection/rivals/flow_clusters.hpp"
#include "redbee/detection/rivals/graded_score.hpp"
#include "redbee/detection/rivals/registration.hpp"

namespace redbee {
namespace {

constexpr double kThresholdPx = 1.0;  // not tuned, as the score sweeps it
constexpr float kReachPx = 24;
constexpr int kAveragePx = 15;
constexpr float kDecisionFraction = 0.58F;
constexpr double kDirectionError = 0.05;   // of the parallax
constexpr double kNearestFraction = 0.15;  // of the height
constexpr double kGroundSlack = 0.1;
constexpr double kNearestBaselines = 4;

GridFlowParameters gridParameters() {
  GridFlowParameters parameters;
  parameters.grid_px = {10, 10};
  parameters.window_px = 13;
  parameters.min_eigenvalue = 1e-3;
  parameters.max_there_and_back_px = 0.5;
  return parameters;
}

std::vector<MovingPoint> strayPoints(const GridTracks& tracks, const EgoMotion& motion) {
  std::vector<MovingPoint> points;
  for (size_t i = 0; i < tracks.current.size(); ++i) {
    const auto segment = motion.segmentOf(tracks.previous[i]);
    if (!segment) continue;
    const Eigen::Vector2d off = segmentResidual(*segment, tracks.current[i]);
    const Eigen::Vector2d moved(tracks.current[i].x - segment->farthest.x(),
                                tracks.current[i].y - segment->farthest.y());
    const double ratio = off.norm() / (kThresholdPx + kDirectionError * moved.norm());
    points.push_back({tracks.current[i],
                      {static_cast<float>(off.x()), static_cast<float>(off.y())},
                      static_cast<float>(ratio)});
  }
  return points;
}

}  // namespace

Meier::Meier(const ObjectParameters& objects) : Rival(objects), flow_(gridParameters()) {}

RivalScore Meier::scoreFrame(const FrameInput& input) {
  RivalScore scored;
  const bool first = !flow_.hasPrevious();
  const GridTracks tracks = flow_.advance(input.grey);
  if (first) return scored;
  std::optional<EgoMotion> motion;
  std::optional<cv::Matx33d> background;
  if (input.motion) {
    motion.emplace(*input.motion, input.cameras(), kNearestFraction, kGroundSlack);
    cv::eigen2cv(planeHomography(input.cameras(), *input.motion), background.emplace());
  } else {
    motion = EgoMotion::fromTracks(tracks, input.K, kNearestBaselines);
    background = registerTracks(tracks);
  }
  if (!motion) {
    scored.status = DetectorStatus::kNoHomography;
    return scored;
  }
  scored.status = DetectorStatus::kGood;
  scored.background = background.value_or(cv::Matx33d::eye());
  ClusterParameters clusters;
  clusters.reach_px = kReachPx;
  scored.score = averagedScore(paintClusters(input.grey.size(), strayPoints(tracks, *motion), clusters),
                               kAveragePx, kDecisionFraction);
  return scored;
}

}  // namespace redbee
