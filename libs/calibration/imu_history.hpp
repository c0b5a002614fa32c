// A complete IMU recording, with rotations and samples between any two times.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee::calibration {

/// Times are seconds since an origin common to all inputs of one calibration, on the IMU's clock.
class ImuHistory {
 public:
  struct Sample {
    double t_s;
    Eigen::Vector3d gyro;   ///< rad/s in I
    Eigen::Vector3d accel;  ///< m/s^2, specific force in I
  };

  /// Sorted by their own times; of samples at the same time the first is kept; non-finite ones are left out.
  ImuHistory(const std::vector<ImuSample>& samples, ImuTime origin);

  bool empty() const { return samples_.empty(); }
  size_t size() const { return samples_.size(); }
  double begin_s() const { return samples_.front().t_s; }
  double end_s() const { return samples_.back().t_s; }
  /// True if samples cover [from_s, to_s] without a gap longer than `max_gap_s`.
  bool covers(double from_s, double to_s, double max_gap_s) const;

  /// Samples on [from, to], from < to, both ends interpolated linearly. Precondition: covered.
  std::vector<Sample> between(double from_s, double to_s) const;
  /// R_IaIb between the times a and b, from the uncorrected gyro. Times beyond the samples are clamped.
  Eigen::Matrix3d rotation(double a_s, double b_s) const;
  /// Mean angular rate in I between the times [rad/s], the rotation vector over the duration.
  Eigen::Vector3d meanRate(double a_s, double b_s) const;

 private:
  /// Index of the last sample at or before t, at most size - 2.
  size_t indexBefore(double t_s) const;
  Sample at(double t_s) const;
  Eigen::Quaterniond attitudeAt(double t_s) const;

  std::vector<Sample> samples_;
  std::vector<Eigen::Quaterniond> attitudes_;  ///< from I at the first sample to I at each: R_I0Ik
};

}  // namespace redbee::calibration
