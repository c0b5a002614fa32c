// A GoPro's MP4: frames and the gyro and accelerometer of its GPMF track.
#pragma once

#include <filesystem>

#include "redbee/files/progress.hpp"
#include "redbee/importers/import.hpp"
#include "redbee/importers/import_video.hpp"

namespace redbee {

struct GoproImportOptions {
  std::filesystem::path video;
  std::filesystem::path log;  ///< to be written
  int width = 854;            ///< px, the height keeps the aspect, both even; 0: as recorded
  FrameFormat format = FrameFormat::kMjpeg;
  int jpeg_quality = 90;
  ImportChannels channels;
};

/// All times are on the video's clock; what is left between gyro and exposure is the configuration's
/// camera.timeshift_s. IMU frame: x forward along the optical axis, y left, z up (gopro_imu.hpp). Throws
/// InputError, and then there is no log.
ImportSummary importGopro(const GoproImportOptions& options, Progress& progress);

}  // namespace redbee
