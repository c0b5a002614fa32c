// The time shift between camera and IMU that makes vision's rotations those of the gyro.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "redbee/inertial/gyro_integral.hpp"

namespace redbee {

/// The camera's rotation between two exposures by vision, in the axes of the IMU.
struct VisualRate {
  double from_s;  ///< exposures on the IMU's clock, by the configured time shift
  double to_s;
  Eigen::Vector3d rate;  ///< rad/s
};

struct TimeshiftFit {
  double shift_s;  ///< to be added to the configured time shift
  double sigma_s;  ///< one standard deviation
};

struct TimeshiftFitOptions {
  double max_shift_s = 0.25;
  /// Of the variance of vision's rates, what may be left at the best shift: without rotation it is noise,
  /// which no shift explains.
  double max_unexplained = 0.5;
};

/// Least squares for the shift together with the gyro's bias and scale, and with a mounting that is off by
/// some degrees, as those of nominal calibrations are. vision ~ (1 + s) (I + [m]x) gyro(t + shift) + bias;
/// robust against outliers, each axis weighed by its own noise. The sigma is the jackknife's over blocks of
/// seconds, because vision's errors are correlated over frames. std::nullopt where too few rates are covered
/// by the gyro, where no shift within reach explains them, or where the best is at the end of the reach.
std::optional<TimeshiftFit> fitTimeshift(const std::vector<VisualRate>& vision, const GyroIntegral& gyro,
                                         const TimeshiftFitOptions& options = {});

}  // namespace redbee
