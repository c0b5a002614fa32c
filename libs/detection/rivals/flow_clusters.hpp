// Clusters points that move independently of the camera into objects, and draws objects as a map.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

/// A point of the current image and its motion after compensation of the camera's.
struct MovingPoint {
  cv::Point2f at;      ///< px
  cv::Point2f motion;  ///< px
  float ratio;         ///< evidence over its decision threshold
};

struct ClusterParameters {
  float reach_px = 16;  ///< px: neighbours
  float motion_px = 1;  ///< px: largest difference of motion, plus motion_fraction of the longer motion
  float motion_fraction = 0.3F;
  size_t min_points = 3;
};

struct FlowCluster {
  std::vector<cv::Point2f> points;  ///< px
  cv::Point2f centre;               ///< px
  cv::Point2f motion;               ///< px, mean
};

/// Points belong to one cluster if a chain of neighbours with similar motion connects them.
std::vector<FlowCluster> clusterFlow(const std::vector<MovingPoint>& points,
                                     const ClusterParameters& parameters);

/// Sets the convex hull of the points, extended by a margin, to `value`.
void paintHull(cv::Mat1b& map, const std::vector<cv::Point2f>& points, float margin_px, uint8_t value);

/// Selects the clusters of one decision level that are objects; level 0 has the lowest threshold.
using ClusterChoice = std::function<std::vector<FlowCluster>(size_t level, std::vector<FlowCluster>)>;

/// A graded score from a binary method: the decision is repeated at thresholds from 1/4 to 16 times the
/// method's own, and a pixel's score is that of the highest threshold at which a cluster's hull contains it.
/// Thresholding at kDecisionScore gives the method's own decision.
cv::Mat1b paintClusters(cv::Size image, const std::vector<MovingPoint>& points,
                        const ClusterParameters& parameters, const ClusterChoice& choose = {});
inline constexpr size_t kDecisionLevels = 13;

}  // namespace redbee
