// The common part of importers of video files.
#pragma once

#include <cstdint>
#include <filesystem>

#include "redbee/files/progress.hpp"
#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/import.hpp"

namespace redbee {

struct VideoSource {
  std::filesystem::path file;
  int64_t start_us = 0;  ///< of the file's clock on the log's
};

/// What the container states of a file.
struct VideoPart {
  int rotation_deg = 0;     ///< clockwise; the images are turned
  int64_t duration_us = 0;  ///< 0: not stated
};

/// Decodes the file into the merger; sets the summary's image size and adds its warnings. Throws InputError.
VideoPart addVideoFrames(const VideoSource& source, const ImportOptions& options, FlightMerger& merger,
                         ImportSummary& summary, Progress& progress);

}  // namespace redbee
