// Points that move on their own, gathered into objects, and objects painted as a map.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

/// A point of the current image and the motion that the camera's does not explain.
struct StrayPoint {
  cv::Point2f at;      ///< px
  cv::Point2f motion;  ///< px
  float ratio;         ///< evidence over its decision threshold
};

struct ClusterParameters {
  float reach_px = 16;  ///< px: neighbours
  float motion_px = 1;  ///< px: like motion, plus motion_fraction of the longer of the two
  float motion_fraction = 0.3F;
  size_t min_points = 3;
};

struct FlowCluster {
  std::vector<cv::Point2f> points;  ///< px
  cv::Point2f centre;               ///< px
  cv::Point2f motion;               ///< px, mean
};

/// Points are of one cluster where a chain of neighbours with like motion joins them.
std::vector<FlowCluster> clusterFlow(const std::vector<StrayPoint>& points,
                                     const ClusterParameters& parameters);

/// Convex hull of the points, each with a margin around it, set to `value`.
void paintHull(cv::Mat1b& map, const std::vector<cv::Point2f>& points, float margin_px, uint8_t value);

/// Which clusters of one decision level count as objects; level 0, 1, ... from the most lenient.
using ClusterChoice = std::function<std::vector<FlowCluster>(size_t level, std::vector<FlowCluster>)>;

/// A graded score from a method that decides: the decision is made at thresholds from 1/4 to 16 times the
/// method's own, and a pixel's score is that of the strictest at which a cluster's hull holds it. At
/// kDecisionScore the map is the method's own decision.
cv::Mat1b paintClusters(cv::Size image, const std::vector<StrayPoint>& points,
                        const ClusterParameters& parameters, const ClusterChoice& choose = {});
inline constexpr size_t kDecisionLevels = 13;

}  // namespace redbee
