// Position and velocity of one object on the ground, over time.
#pragma once

#include <Eigen/Core>

namespace redbee {

/// What the errors of a measurement have in common with those of the measurements before: attitude (3),
/// position (2), height, focal length, foot (2).
inline constexpr int kLastingErrors = 9;
inline constexpr int kFirstFootError = 7;

/// z = position + G e + v: e are the lasting errors, each of unit variance, v is new in every frame.
struct GroundMeasurement {
  Eigen::Vector2d z;                           ///< m, east and north
  Eigen::Matrix<double, 2, kLastingErrors> G;  ///< m
  Eigen::Matrix2d R;                           ///< m^2, covariance of v
};

/// A filter whose covariance P takes the lasting errors into account, first-order Gauss-Markov processes
/// that are carried along with their correlation C to the state and never estimated (Schmidt): what many
/// frames have in common does not average out.
///
/// Its gain is not that of Schmidt's filter, which takes each change of G for knowledge of the errors: as G
/// is computed where the object is believed to be, changes of that belief would count. The gain comes from a
/// covariance W of the object's *apparent* place, with the lasting errors but the foot's on it: they move it
/// as far as they change. P follows from any gain (Joseph's form).
class TargetFilter {
 public:
  /// At rest, with this velocity's standard deviation [m/s].
  TargetFilter(const GroundMeasurement& first, double velocity_sigma);

  struct Prediction {
    double seconds = 0;
    double acceleration_sigma = 0;   ///< m/s^2 within a second
    double velocity_decay_s = 0;     ///< s; 0: the velocity lasts
    double error_correlation_s = 0;  ///< s, of the lasting errors but the foot's
    double foot_correlation_s = 0;   ///< s
  };
  void predict(const Prediction& prediction);
  /// Squared Mahalanobis distance of a measurement from the predicted apparent place; 2 degrees of freedom.
  double distance(const GroundMeasurement& measurement) const;
  void update(const GroundMeasurement& measurement);
  /// The object does not move: it stopped somewhere between `last_seen` [m] and where it is predicted.
  void stop(const Eigen::Vector2d& last_seen, double velocity_sigma);

  Eigen::Vector2d position() const { return state_.head<2>(); }
  Eigen::Vector2d velocity() const { return state_.tail<2>(); }
  /// East, north, their velocities: m, m/s.
  const Eigen::Vector4d& state() const { return state_; }
  const Eigen::Matrix4d& covariance() const { return P_; }

 private:
  using Cross = Eigen::Matrix<double, 4, kLastingErrors>;
  using FootCross = Eigen::Matrix<double, 4, kLastingErrors - kFirstFootError>;
  Eigen::Matrix2d innovationCovariance(const GroundMeasurement& measurement) const;

  Eigen::Vector4d state_;
  Eigen::Matrix4d P_;
  Cross C_;
  Eigen::Matrix4d W_;
  FootCross D_;  ///< of W's error with the foot's
  Eigen::Matrix<double, 2, kFirstFootError> last_G_;
};

}  // namespace redbee
