// A GoPro's MP4: frames and the gyro and accelerometer of its GPMF track.
#pragma once

#include "redbee/importers/importer.hpp"

namespace redbee {

/// All times are on the video's clock; the remaining shift between gyro and exposure is the configuration's
/// camera.timeshift_s. IMU frame: x forward along the optical axis, y left, z up (gopro_imu.hpp).
Importer goproImporter();

}  // namespace redbee
