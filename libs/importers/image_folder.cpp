#include "redbee/importers/image_folder.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
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

std::string extensionOf(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// macOS puts a hidden ._NAME.jpg beside each file, which is none.
bool isImage(const fs::path& file) {
  if (file.filename().string().front() == '.') return false;
  const std::string extension = extensionOf(file);
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
}

/// What there is most of among the images of other formats; empty where there are none.
std::string otherImages(const fs::path& folder) {
  std::map<std::string, int> counts;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = extensionOf(entry.path());
    for (const char* known : {".tif", ".tiff", ".bmp", ".webp", ".ppm", ".pgm", ".jp2", ".heic", ".avif",
                              ".dng", ".raw", ".exr", ".npy"})
      if (entry.path().stem().string().front() != '.' && extension == known) ++counts[extension];
  }
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == counts.end()) return "";
  return ", but " + std::to_string(most->second) + " " + most->first + ": convert them to PNG";
}

std::vector<fs::path> listImages(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && isImage(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), isFileNaturallyBefore);
  if (files.empty()) throw InputError(folder, "holds no JPEG or PNG images" + otherImages(folder));
  for (size_t i = 1; i < files.size(); ++i) {
    if (files[i].stem() == files[i - 1].stem())
      throw InputError(files[i], "stands beside " + files[i - 1].filename().string() +
                                     ": is each frame there in two formats? Keep one of them in the folder");
  }
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
