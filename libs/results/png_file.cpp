#include "redbee/results/png_file.hpp"

#include <vector>

#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/image_codec/image_codec.hpp"
#include "redbee/image_codec/png.hpp"

namespace redbee {

void writePng(const std::filesystem::path& file, const cv::Mat& image) {
  if (image.empty()) throw InputError(file, "the image cannot be encoded as PNG");
  const std::vector<uint8_t> bytes = encodePng(image);
  writeAtomically(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

cv::Mat1b readGreyPng(const std::filesystem::path& file) {
  const cv::Mat1b image = decodeGreyImage(readWhole(file));
  if (image.empty()) throw InputError(file, "not a readable image");
  return image;
}

}  // namespace redbee
