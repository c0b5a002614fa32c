#include "redbee/detection/rivals/flow_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/rivals/graded_score.hpp"

namespace redbee {
namespace {

float ratioOfLevel(size_t level) { return 0.25F * std::pow(2.0F, 0.5F * static_cast<float>(level)); }

}  // namespace

std::vector<FlowCluster> clusterFlow(const std::vector<MovingPoint>& points,
                                     const ClusterParameters& parameters) {
  const auto alike = [&](const MovingPoint& a, const MovingPoint& b) {
    const float reach = static_cast<float>(cv::norm(a.at - b.at));
    if (reach > parameters.reach_px) return false;
    const double longer = std::max(cv::norm(a.motion), cv::norm(b.motion));
    return cv::norm(a.motion - b.motion) <= parameters.motion_px + parameters.motion_fraction * longer;
  };
  std::vector<int> labels;
  const int count = points.empty() ? 0 : cv::partition(points, labels, alike);
  std::vector<FlowCluster> clusters(static_cast<size_t>(count));
  for (size_t i = 0; i < points.size(); ++i) {
    FlowCluster& cluster = clusters[static_cast<size_t>(labels[i])];
    cluster.points.push_back(points[i].at);
    cluster.centre += points[i].at;
    cluster.motion += points[i].motion;
  }
  const auto small = [&](const FlowCluster& c) { return c.points.size() < parameters.min_points; };
  clusters.erase(std::remove_if(clusters.begin(), clusters.end(), small), clusters.end());
  for (FlowCluster& cluster : clusters) {
    cluster.centre /= static_cast<float>(cluster.points.size());
    cluster.motion /= static_cast<float>(cluster.points.size());
  }
  return clusters;
}

void paintHull(cv::Mat1b& map, const std::vector<cv::Point2f>& points, float margin_px, uint8_t value) {
  std::vector<cv::Point2f> corners;
  for (const cv::Point2f& point : points) {
    for (int side = 0; side < 8; ++side) {
      const auto angle = static_cast<float>(side * CV_PI / 4);
      corners.push_back(point + margin_px * cv::Point2f(std::cos(angle), std::sin(angle)));
    }
  }
  std::vector<cv::Point2f> hull;
  cv::convexHull(corners, hull);
  std::vector<cv::Point> outline;
  outline.reserve(hull.size());
  for (const cv::Point2f& corner : hull) outline.emplace_back(cvRound(corner.x), cvRound(corner.y));
  cv::fillConvexPoly(map, outline, cv::Scalar(value));
}

cv::Mat1b paintClusters(cv::Size image, const std::vector<MovingPoint>& points,
                        const ClusterParameters& parameters, const ClusterChoice& choose) {
  cv::Mat1b map = cv::Mat1b::zeros(image);
  std::vector<MovingPoint> stray = points;
  for (size_t level = 0; level < kDecisionLevels; ++level) {
    const float ratio = ratioOfLevel(level);
    const auto within = [&](const MovingPoint& point) { return point.ratio < ratio; };
    stray.erase(std::remove_if(stray.begin(), stray.end(), within), stray.end());
    std::vector<FlowCluster> clusters = clusterFlow(stray, parameters);
    if (choose) clusters = choose(level, std::move(clusters));
    for (const FlowCluster& cluster : clusters)
      paintHull(map, cluster.points, parameters.reach_px / 3, gradedScore(ratio));
  }
  return map;
}

}  // namespace redbee
