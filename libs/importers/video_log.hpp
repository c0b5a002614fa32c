// The part that every import from a video file shares.
#pragma once

#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/import_video.hpp"

namespace redbee {

/// Decodes the whole file into the merger and fills the summary's image size.
void addVideoFrames(const ImportOptions& options, FlightMerger& merger, ImportSummary& summary,
                    Progress& progress);

}  // namespace redbee
