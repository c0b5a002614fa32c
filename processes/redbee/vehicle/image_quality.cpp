#include "processes/redbee/vehicle/image_quality.hpp"

#include <opencv2/imgproc.hpp>

#include "redbee/bus/image.hpp"
#include "redbee/geometry/median.hpp"
#include "redbee/visual/sharpness.hpp"

namespace redbee {
namespace {

constexpr int64_t kLookPeriod = 6;  // images

double fractionOf(const cv::Mat& chosen) {
  return static_cast<double>(cv::countNonZero(chosen)) / static_cast<double>(chosen.total());
}

}  // namespace

void ImageQuality::note(const image_t& image) {
  if (images_++ % kLookPeriod != 0) return;
  const auto decoded = decodeGrey(image);
  if (!decoded) {
    ++damaged_;
    return;
  }
  const cv::Mat1b& grey = *decoded;
  cv::Mat1b half;
  cv::resize(grey, half, grey.size() / 2, 0, 0, cv::INTER_AREA);
  cv::Scalar mean, deviation;
  cv::meanStdDev(grey, mean, deviation);
  medians_.push_back(median(std::vector<uint8_t>(half.begin(), half.end())));
  contrasts_.push_back(deviation[0]);
  saturated_.push_back(fractionOf(grey >= kBright));
  dark_.push_back(fractionOf(grey <= kDark));
  sharpness_.push_back(sharpnessOf(half));
}

double ImageQuality::greyMedian() const { return median(medians_); }
double ImageQuality::contrast() const { return median(contrasts_); }
double ImageQuality::saturatedFraction() const { return median(saturated_); }
double ImageQuality::darkFraction() const { return median(dark_); }
double ImageQuality::sharpness() const { return median(sharpness_); }

}  // namespace redbee
