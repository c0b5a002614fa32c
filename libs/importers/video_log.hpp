// The common part of importers of video files.
#pragma once

#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/import_video.hpp"

namespace redbee {

/// Decodes the file into the merger and sets the summary's image size.
void addVideoFrames(const ImportOptions& options, FlightMerger& merger, ImportSummary& summary,
                    Progress& progress);

}  // namespace redbee
