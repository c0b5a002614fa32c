// Any video that ffmpeg reads, or a folder of images, with or without an IMU.
#pragma once

#include <filesystem>
#include <optional>

#include "redbee/files/progress.hpp"
#include "redbee/importers/image_file.hpp"
#include "redbee/importers/import.hpp"

namespace redbee {

enum class FrameFormat {
  kMjpeg,    ///< colour, JPEG
  kRawGrey,  ///< luma, uncompressed
};

struct VideoImportOptions {
  std::filesystem::path video;  ///< a file, or a folder of JPEGs or PNGs taken in the order of their names
  std::filesystem::path log;    ///< to be written
  /// CSV with a header line that names its columns, in any order: t_s [s, on the video's clock], gx gy gz
  /// [rad/s], ax ay az [m/s^2, specific force]. Other columns are ignored. The axes are the IMU's; the
  /// vehicle's R_CI relates the camera to them.
  std::optional<std::filesystem::path> imu;
  double fps = 0;  ///< Hz, of a folder of images; a file has its own times
  int width = 0;   ///< px, the height keeps the aspect, both even; 0: as recorded. Files only
  FrameFormat format = FrameFormat::kMjpeg;
  int jpeg_quality = 90;
  ImportChannels channels;
};

/// Frames have their presentation times, from the video's zero. Throws InputError, and then there is no log.
ImportSummary importVideo(const VideoImportOptions& options, Progress& progress);

/// The IMU file above.
std::vector<ImuSample> readImuCsv(const std::filesystem::path& file);

}  // namespace redbee
