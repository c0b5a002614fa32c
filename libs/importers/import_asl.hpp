// EuRoC's folder layout (ASL): DIR/mav0/{cam0,imu0,altimeter0}/{data.csv,sensor.yaml}; and Kalibr's,
// DIR/cam0/<ns>.png and DIR/imu0.csv.
#pragma once

#include "redbee/importers/importer.hpp"

namespace redbee {

/// Source: the folder that holds mav0, or mav0 itself. Timestamps stay on the clock of their sensor and are
/// rounded from ns to us. imu0 and altimeter0 are optional.
Importer aslImporter();

}  // namespace redbee
