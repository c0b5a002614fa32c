// EuRoC's folder layout (ASL): DIR/mav0/{cam0,imu0,altimeter0}/{data.csv,sensor.yaml}.
#pragma once

#include "redbee/importers/importer.hpp"

namespace redbee {

/// Source: the folder that holds mav0, or mav0 itself. Camera stamps stay on the camera's clock and IMU
/// stamps on the IMU's, as the folder has them; ns become us by rounding to the nearest. imu0 and altimeter0
/// may be absent, cam0 not.
Importer aslImporter();

}  // namespace redbee
