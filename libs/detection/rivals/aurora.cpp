#include "redbee/detection/rivals/aurora.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/rivals/graded_score.hpp"
#include "redbee/detection/rivals/stabilise.hpp"

namespace redbee {
namespace {

constexpr int kSmoothPx = 3;
constexpr float kDeviations = 0.1F;

}  // namespace

RecursiveDensity::RecursiveDensity(cv::Size size, const Parameters& parameters)
    : parameters_(parameters),
      mean_(cv::Mat::zeros(size, CV_32FC3)),
      moments_(cv::Mat::zeros(size, CV_32FC3)),
      count_(cv::Mat::zeros(size, CV_32F)) {}

void RecursiveDensity::carry(const cv::Matx33d& H) {
  mean_ = stabilise(mean_, H);
  moments_ = stabilise(moments_, H);
  count_ = stabilise(count_, H, cv::INTER_NEAREST);
  // There the values are mixed with the nothing outside.
  count_.setTo(0, unseenBy(H, count_.size()));
}

cv::Mat RecursiveDensity::update(const cv::Mat& colour) {
  cv::Mat below = cv::Mat::zeros(colour.size(), CV_32F);
  density_.create(colour.size(), CV_32F);
  for (int y = 0; y < colour.rows; ++y) {
    for (int x = 0; x < colour.cols; ++x) {
      const cv::Vec3f value = cv::Vec3f(colour.at<cv::Vec3b>(y, x)) / parameters_.unit;
      auto& mean = mean_.at<cv::Vec3f>(y, x);
      auto& moments = moments_.at<cv::Vec3f>(y, x);
      float& count = count_.at<float>(y, x);
      count = std::min(count + 1, parameters_.longest);
      const float fresh = 1 / count;
      mean += fresh * (value - mean);
      moments[0] += fresh * (value.dot(value) - moments[0]);
      const cv::Vec3f off = value - mean;
      const float spread = std::max(0.0F, moments[0] - mean.dot(mean));
      const float density = 1 / (1 + off.dot(off) + spread);
      density_.at<float>(y, x) = density;
      const float judged = count - static_cast<float>(parameters_.learning_frames);
      if (judged > 0) {
        const float variance = moments[2] - moments[1] * moments[1];
        const float deviation = std::max(parameters_.least_deviation, std::sqrt(std::max(0.0F, variance)));
        below.at<float>(y, x) = std::max(0.0F, (moments[1] - density) / deviation);
      }
      const float share = 1 / std::max(1.0F, judged + 1);
      moments[1] += share * (density - moments[1]);
      moments[2] += share * (density * density - moments[2]);
    }
  }
  return below;
}

void Aurora::reset() {
  registrar_.reset();
  density_.reset();
}

RivalOutput Aurora::judge(const RivalInput& input) {
  RivalOutput output;
  const bool first = !registrar_.hasPrevious();
  const auto registration = registrar_.advance(input.grey);
  if (first) {
    density_.emplace(input.grey.size(), parameters_.density);
  } else if (!registration) {
    output.status = RivalStatus::kLost;
    return output;
  } else {
    density_->carry(*registration);
    output.background = *registration;
    output.status = RivalStatus::kGood;
  }
  cv::Mat smooth;
  cv::GaussianBlur(input.colour, smooth, {kSmoothPx, kSmoothPx}, 0);
  cv::Mat below = density_->update(smooth);
  cv::blur(below, below, {parameters_.average_px, parameters_.average_px});
  output.score = gradedScore(below, kDeviations);
  return output;
}

}  // namespace redbee
