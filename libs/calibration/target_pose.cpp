#include "redbee/calibration/target_pose.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

constexpr size_t kMinCorners = 8;
constexpr double kHuber_px = 1.0;
constexpr double kSigmaFloor_px = 0.05;
constexpr double kWorstRms_px = 3.0;

using Vector6d = Eigen::Matrix<double, 6, 1>;

struct Normal {
  Matrix6d A = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double squares = 0;  ///< weighted, px^2
  double weights = 0;
};

/// Sums over the corners; the derivative is by a left perturbation of R_CT and by p_CT.
Normal normalEquations(const Camera& camera, const std::vector<Eigen::Vector2d>& ideal,
                       const TargetView& view, const Eigen::Matrix3d& R, const Eigen::Vector3d& p) {
  Normal sum;
  for (size_t i = 0; i < ideal.size(); ++i) {
    const Eigen::Vector3d turned = R * view.corners[i];
    const Eigen::Vector3d X = turned + p;
    const Eigen::Vector2d f(camera.K()(0, 0), camera.K()(1, 1));
    const Eigen::Vector2d residual = ideal[i] - (camera.K() * X).hnormalized();
    Eigen::Matrix<double, 2, 3> project;
    project << f.x() / X.z(), 0, -f.x() * X.x() / (X.z() * X.z()), 0, f.y() / X.z(),
        -f.y() * X.y() / (X.z() * X.z());
    Eigen::Matrix<double, 2, 6> J;
    J << -project * skew(turned), project;
    const double weight = std::min(1.0, kHuber_px / std::max(residual.norm(), 1e-9));
    sum.A += weight * J.transpose() * J;
    sum.b += weight * J.transpose() * residual;
    sum.squares += weight * residual.squaredNorm();
    sum.weights += weight;
  }
  return sum;
}

bool roughPose(const Camera& camera, const std::vector<Eigen::Vector2d>& ideal, const TargetView& view,
               Eigen::Matrix3d& R, Eigen::Vector3d& p) {
  std::vector<cv::Point2d> pixels;
  std::vector<cv::Point3d> corners;
  for (size_t i = 0; i < ideal.size(); ++i) {
    pixels.emplace_back(ideal[i].x(), ideal[i].y());
    corners.emplace_back(view.corners[i].x(), view.corners[i].y(), view.corners[i].z());
  }
  cv::Matx33d K;
  cv::eigen2cv(camera.K(), K);
  cv::Vec3d rotation, translation;
  try {
    if (!cv::solvePnP(corners, pixels, K, cv::noArray(), rotation, translation)) return false;
  } catch (const cv::Exception&) {  // such as collinear corners
    return false;
  }
  R = expSO3({rotation[0], rotation[1], rotation[2]});
  p = {translation[0], translation[1], translation[2]};
  return R.allFinite() && p.allFinite() && p.z() > 0;
}

}  // namespace

std::optional<TargetPose> estimateTargetPose(const Camera& camera, const TargetView& given) {
  if (given.pixels.size() != given.corners.size()) return std::nullopt;
  TargetView view;  // as given, without the corners that the camera model refuses
  view.time = given.time;
  std::vector<Eigen::Vector2d> ideal;
  for (size_t i = 0; i < given.pixels.size(); ++i) {
    const auto pixel = camera.undistort(given.pixels[i]);
    if (!pixel) continue;
    ideal.push_back(*pixel);
    view.pixels.push_back(given.pixels[i]);
    view.corners.push_back(given.corners[i]);
  }
  if (ideal.size() < kMinCorners) return std::nullopt;
  Eigen::Matrix3d R;
  Eigen::Vector3d p;
  if (!roughPose(camera, ideal, view, R, p)) return std::nullopt;

  constexpr int kIterations = 6;
  Normal sum;
  for (int i = 0; i < kIterations; ++i) {
    sum = normalEquations(camera, ideal, view, R, p);
    const Vector6d step = sum.A.ldlt().solve(sum.b);
    if (!step.allFinite()) return std::nullopt;
    R = nearestRotation(expSO3(step.head<3>()) * R);
    p += step.tail<3>();
  }
  const double freedom = 2.0 * sum.weights - 6.0;
  const double variance = std::max(sum.squares / freedom, kSigmaFloor_px * kSigmaFloor_px);
  TargetPose pose;
  pose.q_CT = Eigen::Quaterniond(R);
  pose.p_CT = p;
  pose.information = sum.A / variance;
  pose.rms_px = std::sqrt(sum.squares / sum.weights);
  if (!(pose.rms_px < kWorstRms_px) || p.z() <= 0) return std::nullopt;
  return pose;
}

}  // namespace redbee::calibration
