#include "redbee/geolocation/target_filter.hpp"

#include <Eigen/LU>
#include <cmath>

namespace redbee {

namespace {

constexpr int kFootErrors = kLastingErrors - kFirstFootError;

Eigen::Matrix<double, 2, kFootErrors> footOf(const GroundMeasurement& m) {
  return m.G.rightCols<kFootErrors>();
}

Eigen::Matrix4d symmetric(const Eigen::Matrix4d& P) { return 0.5 * (P + P.transpose()); }

Eigen::Matrix4d transition(double position_gain, double velocity_left) {
  Eigen::Matrix4d F = Eigen::Matrix4d::Identity();
  F.topRightCorner<2, 2>().diagonal().setConstant(position_gain);
  F.bottomRightCorner<2, 2>().diagonal().setConstant(velocity_left);
  return F;
}

/// Of an acceleration that is white noise.
Eigen::Matrix4d accelerationNoise(double dt, double sigma) {
  const double q = sigma * sigma;
  Eigen::Matrix4d Q = Eigen::Matrix4d::Zero();
  Q.topLeftCorner<2, 2>().diagonal().setConstant(q * dt * dt * dt / 3);
  Q.topRightCorner<2, 2>().diagonal().setConstant(q * dt * dt / 2);
  Q.bottomLeftCorner<2, 2>().diagonal().setConstant(q * dt * dt / 2);
  Q.bottomRightCorner<2, 2>().diagonal().setConstant(q * dt);
  return Q;
}

}  // namespace

TargetFilter::TargetFilter(const GroundMeasurement& first, double velocity_sigma)
    : state_(first.z.x(), first.z.y(), 0, 0), last_G_(first.G.leftCols<kFirstFootError>()) {
  P_.setZero();
  P_.topLeftCorner<2, 2>() = first.G * first.G.transpose() + first.R;
  P_.bottomRightCorner<2, 2>() = velocity_sigma * velocity_sigma * Eigen::Matrix2d::Identity();
  C_.setZero();
  C_.topRows<2>() = -first.G;
  W_ = P_;
  W_.topLeftCorner<2, 2>() = footOf(first) * footOf(first).transpose() + first.R;
  D_.setZero();
  D_.topRows<2>() = -footOf(first);
}

void TargetFilter::predict(const Prediction& prediction) {
  const double dt = prediction.seconds;
  const double tau = prediction.velocity_decay_s;
  const double left = tau > 0 ? std::exp(-dt / tau) : 1;
  const Eigen::Matrix4d F = transition(tau > 0 ? tau * (1 - left) : dt, left);
  const Eigen::Matrix4d Q = accelerationNoise(dt, prediction.acceleration_sigma);
  const double lasting = std::exp(-dt / prediction.error_correlation_s);
  const double foot = std::exp(-dt / prediction.foot_correlation_s);
  state_ = F * state_;
  P_ = F * P_ * F.transpose() + Q;
  C_ = F * C_;
  C_.leftCols<kFirstFootError>() *= lasting;
  C_.rightCols<kFootErrors>() *= foot;
  W_ = F * W_ * F.transpose() + Q;
  W_.topLeftCorner<2, 2>() += (1 - lasting * lasting) * last_G_ * last_G_.transpose();
  D_ = F * D_ * foot;
}

Eigen::Matrix2d TargetFilter::innovationCovariance(const GroundMeasurement& m) const {
  const Eigen::Matrix2d cross = D_.topRows<2>() * footOf(m).transpose();
  return W_.topLeftCorner<2, 2>() + cross + cross.transpose() + footOf(m) * footOf(m).transpose() + m.R;
}

double TargetFilter::distance(const GroundMeasurement& m) const {
  const Eigen::Vector2d innovation = m.z - position();
  return innovation.dot(innovationCovariance(m).inverse() * innovation);
}

void TargetFilter::update(const GroundMeasurement& m) {
  const Eigen::Matrix2d S = innovationCovariance(m);
  const Eigen::Matrix<double, 4, 2> K = (W_.leftCols<2>() + D_ * footOf(m).transpose()) * S.inverse();
  Eigen::Matrix4d A = Eigen::Matrix4d::Identity();
  A.leftCols<2>() -= K;
  state_ += K * (m.z - position());
  const Eigen::Matrix4d cross = A * C_ * m.G.transpose() * K.transpose();
  P_ = symmetric(A * P_ * A.transpose() + K * (m.G * m.G.transpose() + m.R) * K.transpose() - cross -
                 cross.transpose());
  C_ = A * C_ - K * m.G;
  W_ = symmetric(W_ - K * S * K.transpose());
  D_ = A * D_ - K * footOf(m);
  last_G_ = m.G.leftCols<kFirstFootError>();
}

void TargetFilter::stop(const Eigen::Vector2d& last_seen, double velocity_sigma) {
  const Eigen::Vector2d half = (position() - last_seen) / 2;
  state_.head<2>() -= half;
  state_.tail<2>().setZero();
  C_.bottomRows<2>().setZero();
  D_.bottomRows<2>().setZero();
  for (Eigen::Matrix4d* P : {&P_, &W_}) {
    P->topRightCorner<2, 2>().setZero();
    P->bottomLeftCorner<2, 2>().setZero();
    P->topLeftCorner<2, 2>() += half * half.transpose();
    P->bottomRightCorner<2, 2>() = velocity_sigma * velocity_sigma * Eigen::Matrix2d::Identity();
  }
}

}  // namespace redbee
