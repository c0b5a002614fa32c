// The focal length of each image of a recording, as the camera wrote it beside them: LENS.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "redbee/image_codec/jpeg.hpp"
#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/import.hpp"

namespace redbee {

/// Focal length that a camera on film of 36 mm width would have for the same view.
struct EquivalentFocalLength {
  int64_t utime = 0;  ///< us, since the first image
  double mm = 0;
};

/// The subtitles that DJI's cameras write beside a video, one an image: `[focal_len : 24.00]`, and
/// `[dzoom_ratio : 2.0]` or `[zoom : 2.0]`, what is cropped; older ones in tenths of a mm and in 1/10000.
/// Empty where they state no focal length. Throws InputError for a file that cannot be read.
std::vector<EquivalentFocalLength> readDjiSubtitles(const std::filesystem::path& file);

/// The subtitles beside a video, by its name with .SRT or .srt.
std::optional<std::filesystem::path> subtitlesBeside(const std::filesystem::path& video);

/// Gives them to the log, and says in the summary what LENS states at the first image, whose focal length the
/// vehicle file is about; the lens is enabled there where it zooms.
class LensRecord {
 public:
  void add(const EquivalentFocalLength& focal, FlightMerger& merger);
  /// Of an image's EXIF data.
  void add(int64_t utime, const ExifLens& lens, FlightMerger& merger);
  /// After the last image.
  void describe(ImportSummary& summary) const;

 private:
  double first_mm_ = 0;  ///< equivalent; 0: none yet
  double shortest_mm_ = 0, longest_mm_ = 0;
  double first_stated_ = 0;  ///< of EXIF, in its own millimetres
};

}  // namespace redbee
