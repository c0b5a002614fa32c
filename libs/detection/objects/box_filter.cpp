#include "redbee/detection/objects/box_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/small_decompositions.hpp"

namespace redbee {
namespace {

// Relative to the object's size, the root of its box's area: people and vehicles alike cover a few times
// their own size in a second.
constexpr double kFirstSpeed = 2;    // 1/s, sigma of the velocity of a new track
constexpr double kAcceleration = 2;  // 1/s^2 per root Hz: white acceleration
constexpr double kSizeChange = 0.5;  // per root s: limbs, turns, and what of a body is found
constexpr double kLeastSide_px = 2;

using EdgesOfState = Eigen::Matrix<double, 4, 6>;

/// d edges / d state; the edges are linear in it.
EdgesOfState edgesOfState() {
  EdgesOfState H = EdgesOfState::Zero();
  H(0, 0) = H(1, 1) = H(2, 0) = H(3, 1) = 1;
  H(0, 2) = H(1, 3) = -0.5;
  H(2, 2) = H(3, 3) = 0.5;
  return H;
}

}  // namespace

BoxFilter::BoxFilter(const BoxMeasurement& first) : state_(State::Zero()), covariance_(Covariance::Zero()) {
  const Eigen::Vector2d low = first.edges_px.head<2>();
  const Eigen::Vector2d high = first.edges_px.tail<2>();
  state_.head<2>() = 0.5 * (low + high);
  state_.segment<2>(2) = (high - low).cwiseMax(kLeastSide_px);
  for (int axis = 0; axis < 2; ++axis) {
    const double a = first.variance_px2(axis), b = first.variance_px2(2 + axis);
    covariance_(axis, axis) = 0.25 * (a + b);
    covariance_(2 + axis, 2 + axis) = a + b;
    covariance_(axis, 2 + axis) = covariance_(2 + axis, axis) = 0.5 * (b - a);
    covariance_(4 + axis, 4 + axis) = std::pow(kFirstSpeed * size(), 2);
  }
}

double BoxFilter::size() const { return std::sqrt(state_(2) * state_(3)); }

void BoxFilter::predict(const Eigen::Matrix3d& ground, double elapsed_s, double velocity_decay_s) {
  const Eigen::Vector2d centre = state_.head<2>();
  const Eigen::Vector2d velocity = state_.tail<2>();
  const Eigen::Matrix2d J = transferJacobianPoint(ground, centre);
  const double scale = std::sqrt(std::abs(J.determinant()));
  const double denominator = ground.row(2).dot(centre.homogeneous());
  const double decay = std::exp(-elapsed_s / velocity_decay_s);
  const double travel_s = velocity_decay_s * (1 - decay);

  Covariance F = Covariance::Zero();
  F.topLeftCorner<2, 2>() = J;
  F.topRightCorner<2, 2>() = travel_s * J;
  // det J ~ denominator^-3
  F.block<2, 2>(2, 0) = state_.segment<2>(2) * (-1.5 * scale / denominator * ground.row(2).head<2>());
  F.block<2, 2>(2, 2) = scale * Eigen::Matrix2d::Identity();
  F.bottomRightCorner<2, 2>() = decay * J;

  state_.head<2>() = transfer(ground, centre) + travel_s * J * velocity;
  state_.segment<2>(2) *= scale;
  state_.tail<2>() = decay * J * velocity;
  covariance_ = F * covariance_ * F.transpose();
  const double acceleration = std::pow(kAcceleration * size(), 2) * elapsed_s;
  for (int axis = 0; axis < 2; ++axis) {
    covariance_(axis, axis) += acceleration * elapsed_s * elapsed_s / 3;
    covariance_(axis, 4 + axis) += acceleration * elapsed_s / 2;
    covariance_(4 + axis, axis) += acceleration * elapsed_s / 2;
    covariance_(4 + axis, 4 + axis) += acceleration;
    covariance_(2 + axis, 2 + axis) += std::pow(kSizeChange * size(), 2) * elapsed_s;
  }
}

void BoxFilter::loosen(double variance_px2) {
  covariance_.topLeftCorner<2, 2>().diagonal().array() += variance_px2;
}

void BoxFilter::update(const BoxMeasurement& measured) {
  static const EdgesOfState H = edgesOfState();
  const Eigen::Matrix<double, 6, 4> cross = covariance_ * H.transpose();
  Eigen::Matrix4d S = H * cross;
  S.diagonal() += measured.variance_px2;
  const Eigen::Matrix<double, 6, 4> gain = S.llt().solve(cross.transpose()).transpose();
  state_ += gain * (measured.edges_px - H * state_);
  const Covariance kept = Covariance::Identity() - gain * H;
  covariance_ =
      kept * covariance_ * kept.transpose() + gain * measured.variance_px2.asDiagonal() * gain.transpose();
  state_.segment<2>(2) = state_.segment<2>(2).cwiseMax(kLeastSide_px);
}

double BoxFilter::centreDistance(const BoxMeasurement& measured) const {
  const Eigen::Vector2d innovation = measured.centre() - state_.head<2>();
  Eigen::Matrix2d S = covariance_.topLeftCorner<2, 2>();
  S.diagonal() += measured.centreVariance();
  return squaredMahalanobis(innovation, S);
}

cv::Rect2d BoxFilter::box() const {
  return {state_(0) - 0.5 * state_(2), state_(1) - 0.5 * state_(3), state_(2), state_(3)};
}

double BoxFilter::positionSigma() const { return std::sqrt(std::max(covariance_(0, 0), covariance_(1, 1))); }

}  // namespace redbee
