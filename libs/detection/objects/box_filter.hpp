// Kalman filter over an object's box in the image, driven by the camera's motion.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace redbee {

/// A box as four edges - left, top, right, bottom - that are measured independently, so that one which the
/// image's border cuts off can be left open.
struct BoxMeasurement {
  Eigen::Vector4d edges_px;
  Eigen::Vector4d variance_px2;

  Eigen::Vector2d centre() const { return 0.5 * (edges_px.head<2>() + edges_px.tail<2>()); }
  Eigen::Vector2d centreVariance() const { return 0.25 * (variance_px2.head<2>() + variance_px2.tail<2>()); }
};

/// State: centre (2) and size (2) [px], velocity of the centre over the ground (2) [px/s]. The ground's
/// homography carries the centre as a point, the velocity as a direction and the size as a length on it
/// (SORT, Bewley et al. 2016, with the camera's motion as an input).
class BoxFilter {
 public:
  using State = Eigen::Matrix<double, 6, 1>;
  using Covariance = Eigen::Matrix<double, 6, 6>;

  /// At rest over the ground, with the velocities of the moving objects that there are as sigma.
  explicit BoxFilter(const BoxMeasurement& first);

  /// To the next frame. `ground`: homography, previous to current [px]. `velocity_decay_s`: the time in which
  /// the velocity falls to 1/e.
  void predict(const Eigen::Matrix3d& ground, double elapsed_s, double velocity_decay_s);
  /// Adds a variance to the position [px^2], of motion that predict() does not know.
  void loosen(double variance_px2);
  void update(const BoxMeasurement& measured);

  /// Squared Mahalanobis distance of the measured centre from the predicted one: chi-square with 2 degrees
  /// of freedom.
  double centreDistance(const BoxMeasurement& measured) const;

  cv::Rect2d box() const;
  Eigen::Vector2d centre() const { return state_.head<2>(); }
  /// Root of the box's area [px].
  double size() const;
  Eigen::Vector2d velocity() const { return state_.tail<2>(); }
  const State& state() const { return state_; }
  const Covariance& covariance() const { return covariance_; }

  /// Of the centre, one sigma of the wider axis [px].
  double positionSigma() const;

 private:
  State state_;
  Covariance covariance_;
};

}  // namespace redbee
