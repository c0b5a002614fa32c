// The common part of importers of image files.
#pragma once

#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/import.hpp"

namespace redbee {

class Progress;

/// Reads the JPEGs and PNGs of the folder in the natural order of their names, at ImportOptions::fps, into
/// the merger and sets the summary's image size and warnings. Throws InputError.
void addImages(const ImportOptions& options, FlightMerger& merger, ImportSummary& summary,
               Progress& progress);

}  // namespace redbee
