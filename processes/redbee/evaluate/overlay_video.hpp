// redbee overlay: a run's results drawn over its flight.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>

namespace redbee {

struct OverlayOptions {
  std::filesystem::path log;
  std::filesystem::path configuration;
  std::filesystem::path results;  ///< see RunFolder
  std::filesystem::path video;    ///< the MP4 to write
  std::filesystem::path stills;   ///< folder for every `kStillPeriod`th image as PNG; empty: none
  static constexpr int kStillPeriod = 24;
};

/// Calls `draw` with the overlay of each frame that has a mask, in order of time.
void forEachOverlay(const std::filesystem::path& log, const std::filesystem::path& configuration,
                    const std::filesystem::path& results,
                    const std::function<void(int64_t utime, const cv::Mat& drawn)>& draw);

/// Throws InputError if a file cannot be read or written.
void renderOverlay(const OverlayOptions& options);

}  // namespace redbee
