#include "redbee/detection/rivals/ego_motion.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

namespace redbee {
namespace {

constexpr double kInlierPx = 0.5;
constexpr double kConfidence = 0.999;
constexpr double kMinInlierRatio = 0.3;
constexpr size_t kMinPoints = 16;

}  // namespace

EgoMotion::EgoMotion(const Eigen::Matrix3d& R, const Eigen::Vector3d& t, const CameraPair& cameras)
    : rotation_(cameras.K_b * R * cameras.K_a.inverse()), epipole_(cameras.K_b * t) {}

EgoMotion::EgoMotion(const PlaneMotion& motion, const CameraPair& cameras, double nearest_fraction,
                     double ground_slack)
    : EgoMotion(motion.R_ba, motion.t_ba, cameras) {
  ground_ = (1 - ground_slack) / motion.h_a * cameras.K_a.inverse().transpose() * motion.m_a;
  nearest_inverse_depth_ = 1 / (nearest_fraction * motion.h_a);
}

std::optional<EgoMotion> EgoMotion::fromTracks(const GridTracks& tracks, const Eigen::Matrix3d& K,
                                               double nearest_baselines) {
  if (tracks.previous.size() < kMinPoints) return std::nullopt;
  cv::Mat camera;
  cv::eigen2cv(K, camera);
  cv::Mat inlier;
  const cv::Mat E = cv::findEssentialMat(tracks.previous, tracks.current, camera, cv::RANSAC, kConfidence,
                                         kInlierPx, inlier);
  if (E.rows != 3 || E.cols != 3) return std::nullopt;
  if (cv::countNonZero(inlier) < kMinInlierRatio * static_cast<double>(tracks.sampled)) return std::nullopt;
  cv::Mat R, t;
  cv::recoverPose(E, tracks.previous, tracks.current, camera, R, t, inlier);
  Eigen::Matrix3d rotation;
  Eigen::Vector3d direction;
  cv::cv2eigen(R, rotation);
  cv::cv2eigen(t, direction);
  EgoMotion motion(rotation, direction, K);
  motion.nearest_inverse_depth_ = 1 / nearest_baselines;
  return motion;
}

std::optional<EgoMotion::Segment> EgoMotion::segmentOf(const cv::Point2f& previous) const {
  const Eigen::Vector3d pixel(previous.x, previous.y, 1);
  const Eigen::Vector3d at_infinity = rotation_ * pixel;
  const double ground = std::clamp(ground_.dot(pixel), 0.0, nearest_inverse_depth_);
  const Eigen::Vector3d farthest = at_infinity + ground * epipole_;
  const Eigen::Vector3d nearest = at_infinity + nearest_inverse_depth_ * epipole_;
  constexpr double kInFront = 0.1;
  if (farthest.z() < kInFront || nearest.z() < kInFront) return std::nullopt;
  return Segment{farthest.hnormalized(), nearest.hnormalized()};
}

Eigen::Vector2d segmentResidual(const EgoMotion::Segment& segment, const cv::Point2f& current) {
  const Eigen::Vector2d along = segment.nearest - segment.farthest;
  const Eigen::Vector2d from = Eigen::Vector2d(current.x, current.y) - segment.farthest;
  const double length2 = along.squaredNorm();
  const double fraction = length2 > 0 ? std::clamp(from.dot(along) / length2, 0.0, 1.0) : 0.0;
  return from - fraction * along;
}

}  // namespace redbee
