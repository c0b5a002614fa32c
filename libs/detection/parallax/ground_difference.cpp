#include "redbee/detection/parallax/ground_difference.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr std::array<double, 3> kAges_s{1.0 / 6, 1.0 / 3, 0.5};
constexpr double kSpacing_s = 1.0 / 12;  // of the images that are kept
constexpr double kTimeTolerance = 0.9;
constexpr float kNoise = 6;           // grey levels
constexpr float kTolerance_px = 0.6;  // of the registration

/// noise^2 + (tolerance * slope)^2 of each pixel.
cv::Mat1f varianceOf(const cv::Mat1b& grey) {
  constexpr double kSobelSum = 8;
  cv::Mat1s dx, dy;
  cv::Sobel(grey, dx, CV_16S, 1, 0);
  cv::Sobel(grey, dy, CV_16S, 0, 1);
  constexpr auto kPerSquare = static_cast<float>(kTolerance_px * kTolerance_px / (kSobelSum * kSobelSum));
  cv::Mat1f variance(grey.size());
  for (int y = 0; y < grey.rows; ++y) {
    const int16_t* const x_row = dx[y];
    const int16_t* const y_row = dy[y];
    float* const out = variance[y];
    for (int x = 0; x < grey.cols; ++x) {
      const int squares = x_row[x] * x_row[x] + y_row[x] * y_row[x];
      out[x] = kNoise * kNoise + kPerSquare * static_cast<float>(squares);
    }
  }
  return variance;
}

/// The lesser of `least` and the difference to the aligned image.
void keepLesser(const cv::Mat1b& grey, const AlignedImage& earlier, const cv::Mat1f& variance,
                cv::Mat1b& least) {
  for (int y = 0; y < grey.rows; ++y) {
    const uint8_t* const now = grey[y];
    const uint8_t* const then = earlier.grey[y];
    const uint8_t* const unknown = earlier.unknown[y];
    const float* const noise = variance[y];
    uint8_t* const out = least[y];
    for (int x = 0; x < grey.cols; ++x) {
      const auto d = static_cast<float>(now[x] - then[x]);
      const int fraction = static_cast<int>(255 * d * d / (d * d + noise[x]));
      out[x] = static_cast<uint8_t>(std::min<int>(out[x], unknown[x] != 0 ? 0 : fraction));
    }
  }
}

}  // namespace

cv::Mat1b GroundDifference::learn(CameraTime time, const cv::Mat1b& grey, const Eigen::Matrix3d& K) {
  cv::Mat1b least(grey.size(), 255);
  const EarlierFrame* last = nullptr;
  cv::Mat1f variance;
  for (const double age_s : kAges_s) {
    const EarlierFrame* const frame = frames_.aged(time, age_s);
    if (frame == nullptr || frame == last || frame->grey.size() != grey.size()) continue;
    if (last == nullptr) variance = varianceOf(grey);
    last = frame;
    keepLesser(grey, alignImage(*frame, K, 0), variance, least);
  }
  if (last == nullptr) least.setTo(0);
  const EarlierFrame* const newest = frames_.newest();
  if (newest == nullptr || seconds(time - newest->time) >= kTimeTolerance * kSpacing_s) {
    frames_.store(time, grey, K, kAges_s.back());
  }
  return least;
}

}  // namespace redbee
