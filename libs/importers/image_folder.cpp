#include "redbee/importers/image_folder.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "redbee/files/input_error.hpp"
#include "redbee/files/natural_order.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/importers/image_file.hpp"
#include "redbee/importers/stated_lens.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

/// macOS puts a hidden ._NAME.jpg beside each file, which is none.
bool isImage(const fs::path& file) {
  if (file.filename().string().front() == '.') return false;
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
}

std::vector<fs::path> listImages(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && isImage(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), isFileNaturallyBefore);
  if (files.empty()) throw InputError(folder, "holds no JPEG or PNG images");
  return files;
}

}  // namespace

void addImages(const ImportOptions& options, FlightMerger& merger, ImportSummary& summary,
               Progress& progress) {
  if (!std::isfinite(options.fps) || options.fps <= 0) {
    throw InputError(options.source, "is a folder of images: a frame rate above 0 is needed (--fps)");
  }
  const std::vector<fs::path> files = listImages(options.source);
  const ImageOptions images{true, options.jpeg_quality, rangeOf(files)};
  ResolutionCheck resolution;
  LensRecord lens;
  size_t turned = 0;
  for (size_t i = 0; i < files.size(); ++i) {
    const int64_t utime = std::llround(1e6 * static_cast<double>(i) / options.fps);
    const LoadedImage image = loadImage(files[i], utime, images);
    resolution.check(files[i], image.message);
    summary.vehicle.width = image.message.width;
    summary.vehicle.height = image.message.height;
    lens.add(utime, image.lens, merger);
    merger.addFrame(image.message);
    turned += image.is_turned ? 1 : 0;
    progress.update(static_cast<int64_t>(i) + 1, static_cast<int64_t>(files.size()));
  }
  lens.describe(summary);
  if (turned > 0) {
    summary.warnings.push_back(
        std::to_string(turned) + " of " + std::to_string(files.size()) +
        " images are turned as their EXIF orientation says: camera matrix and R_CI are "
        "those of the turned images");
  }
}

}  // namespace redbee
