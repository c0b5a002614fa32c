#include "redbee/imaging/repeated_image.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace redbee {

bool repeats(const cv::Mat1b& image, const cv::Mat1b& earlier, int downscale) {
  constexpr int kBlock_px = 16;
  constexpr double kEncoding = 0.5;  // grey levels, mean of a block's absolute differences
  if (image.empty() || image.size() != earlier.size()) return false;
  const int block_px = kBlock_px / downscale;
  cv::Mat1b difference;
  cv::Mat1i sums;
  for (int y = 0; y < image.rows; y += block_px) {
    const cv::Range rows(y, std::min(y + block_px, image.rows));
    cv::absdiff(image.rowRange(rows), earlier.rowRange(rows), difference);
    cv::reduce(difference, sums, 0, cv::REDUCE_SUM, CV_32S);
    for (int x = 0; x < image.cols; x += block_px) {
      const cv::Mat1i block = sums.colRange(x, std::min(x + block_px, image.cols));
      if (cv::sum(block)[0] > kEncoding * block.cols * rows.size()) return false;
    }
  }
  return true;
}

}  // namespace redbee
