// Any video that ffmpeg reads, or a folder of images, with or without an IMU.
#pragma once

#include "redbee/importers/importer.hpp"

namespace redbee {

/// Source: a file, or a folder of JPEGs or PNGs taken in the natural order of their names. Frames have their
/// presentation times. What the recording states about rotation (display matrix, EXIF) is applied.
Importer videoImporter();

}  // namespace redbee
