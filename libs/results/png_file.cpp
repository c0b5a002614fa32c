#include "redbee/results/png_file.hpp"

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {

void writePng(const std::filesystem::path& file, const cv::Mat& image) {
  std::vector<uint8_t> bytes;
  // Masks compress well at the lowest level already, and a run writes two images a frame.
  if (image.empty() || !cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1})) {
    throw InputError(file, "the image cannot be encoded as PNG");
  }
  writeAtomically(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

cv::Mat1b readGreyPng(const std::filesystem::path& file) {
  requireFile(file);  // OpenCV would write a warning of its own
  cv::Mat image = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw InputError(file, "not a readable image");
  return image;
}

}  // namespace redbee
