// Adds the error of a good calibration to a drone's true extrinsics, reproducibly on every machine.
#pragma once

#include <string_view>

#include "redbee/geometry/angle.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

/// Error of a good calibration. Every amount is exact; the seed draws the rotation's axis and the signs.
struct ExtrinsicsDisturbance {
  double rotation_rad = 0.1 * kDegree;
  double timeshift_s = 0.5e-3;
  double height_fraction = 0.02;  ///< of the start height
};

/// `seed`: any text, such as the clip's name. Its FNV-1a hash seeds SplitMix64 (Steele, Lea, Flood 2014), as
/// the distributions of C++ standard libraries differ. R_CI is turned about an axis of the camera's frame
/// that is uniform on the sphere; start_height_sigma_m becomes the disturbance of the height, if there is
/// one.
InertialExtrinsics disturbed(const InertialExtrinsics& truth, const ExtrinsicsDisturbance& amounts,
                             std::string_view seed);

}  // namespace redbee
