// Whether the IMU and vision see the same rotations: a sequential test, which leaves room for what a
// calibration may be off by, and finds clocks that are not each other's, a turned mounting, a broken gyro.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <string>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/inertial/rotation_difference.hpp"

namespace redbee {

/// One line for people. Positive: the camera's clock is ahead.
std::string disagreementOf(double clock_offset_s);

/// The rotations of one pair of frames a, b.
struct ComparedRotation {
  CameraTime time_previous{};
  CameraTime time{};
  Eigen::Matrix3d R_ba;  ///< by the IMU, camera frames
  RotationDifference difference;
};

/// A pair of frames contradicts where the normalized difference squared exceeds its chi-square quantile. The
/// errors of the pairs are correlated (the same relief stays in view), so times are counted instead of
/// likelihoods, twice where the difference is more than twice as large: as soon as contradicting pairs
/// outlast the others by `disagreement_s`, IMU and vision disagree. A drone that does not turn contradicts
/// nothing, so they agree again only after `agreement_s` in which an offset of `visible_offset_s` would have
/// contradicted, and did not in four of five pairs.
class VisionAgreement {
 public:
  struct Parameters {
    double mounting_sigma = 2 * kDegree;  ///< rad, by which a nominal mounting is off
    double timeshift_sigma_s = 0.01;  ///< s, of a nominal time shift, and of the rows of a rolling shutter
    double probability = 0.95;        ///< of the quantile, 3 degrees of freedom
    double disagreement_s = 1.0;      ///< s
    double agreement_s = 2.0;         ///< s
    double visible_offset_s = 0.05;   ///< s
  };

  VisionAgreement() : VisionAgreement(Parameters()) {}
  explicit VisionAgreement(const Parameters& parameters);

  /// Pairs in order of time; others are ignored.
  void note(const ComparedRotation& pair);
  bool agrees() const { return agrees_; }
  /// s, by how much the contradicting pairs have outlasted the others; for monitoring.
  double contradicted() const { return contradicted_s_; }

  /// s, the offset of the camera's clock to the IMU's, beyond the configured time shift, that explains the
  /// rotations of the last seconds; positive: the camera is ahead. std::nullopt if none within a second
  /// explains them.
  std::optional<double> clockOffset() const;
  /// One line for people, empty while they agree. It changes at most once a second.
  const std::string& message() const { return message_; }

 private:
  struct Rates {
    double time_s;  ///< middle of the pair, since the first one
    double duration_s;
    Eigen::Vector3d inertial;  ///< rad/s
    Eigen::Vector3d visual;    ///< rad/s
  };

  void keep(const Rates& rates);
  /// `squared_ratio`: squared normalized difference over its gate.
  void decide(double squared_ratio, bool offset_is_visible, double duration_s);
  void describe();
  std::optional<double> unexplained(double lag_s) const;

  Parameters parameters_;
  double gate_;
  bool agrees_ = true;
  double contradicted_s_ = 0;
  double confirmed_s_ = 0;
  std::optional<CameraTime> first_;
  std::optional<CameraTime> last_;
  std::deque<Rates> history_;
  std::string message_;
  double described_at_s_ = 0;
};

}  // namespace redbee
