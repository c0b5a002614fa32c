#include "redbee/image_codec/image_codec.hpp"

#include <opencv2/imgproc.hpp>

#include "redbee/image_codec/jpeg.hpp"
#include "redbee/image_codec/png.hpp"

namespace redbee {

bool isJpeg(const std::vector<uint8_t>& bytes) {
  return bytes.size() > 2 && bytes[0] == 0xFF && bytes[1] == 0xD8;
}

bool isPng(const std::vector<uint8_t>& bytes) {
  return bytes.size() > 4 && bytes[0] == 0x89 && bytes[1] == 'P' && bytes[2] == 'N' && bytes[3] == 'G';
}

cv::Mat decodeImage(const std::vector<uint8_t>& bytes) {
  if (isPng(bytes)) return decodePng(bytes);
  if (isJpeg(bytes)) return decodeJpeg(bytes, !isGreyJpeg(bytes));
  return {};
}

cv::Mat1b decodeGreyImage(const std::vector<uint8_t>& bytes) {
  if (isJpeg(bytes)) return decodeJpeg(bytes, false);
  cv::Mat image = isPng(bytes) ? decodePng(bytes) : cv::Mat();
  if (image.depth() == CV_16U) {  // convertTo() would round
    cv::Mat upper(image.rows, image.cols, CV_8UC(image.channels()));
    const auto last = static_cast<int>(image.total() * static_cast<size_t>(image.channels()));
    const auto* values = image.ptr<uint16_t>();
    for (int k = 0; k < last; ++k) upper.data[k] = static_cast<uint8_t>(values[k] >> 8U);
    image = upper;
  }
  if (image.channels() == 3) cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
  return image;
}

}  // namespace redbee
