#include "redbee/detection/rivals/aurora.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/rivals/graded_score.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

constexpr int kSmoothPx = 3;
constexpr float kDeviations = 0.1F;

}  // namespace

RecursiveDensity::RecursiveDensity(cv::Size size, const Parameters& parameters)
    : parameters_(parameters),
      mean_(cv::Mat3f::zeros(size)),
      moments_(cv::Mat3f::zeros(size)),
      count_(cv::Mat1f::zeros(size)) {}

void RecursiveDensity::propagate(const cv::Matx33d& H) {
  mean_ = warpToCurrent(mean_, H, cv::INTER_LINEAR);
  moments_ = warpToCurrent(moments_, H, cv::INTER_LINEAR);
  count_ = warpToCurrent(count_, H, cv::INTER_NEAREST);
  // At the border values are interpolated with zeros outside.
  count_.setTo(0, outsidePrevious(H, count_.size()));
}

cv::Mat1f RecursiveDensity::update(const cv::Mat3b& colour) {
  cv::Mat1f below = cv::Mat1f::zeros(colour.size());
  density_.create(colour.size());
  for (int y = 0; y < colour.rows; ++y) {
    for (int x = 0; x < colour.cols; ++x) {
      const cv::Vec3f value = cv::Vec3f(colour(y, x)) / parameters_.unit;
      auto& mean = mean_(y, x);
      auto& moments = moments_(y, x);
      float& count = count_(y, x);
      count = std::min(count + 1, parameters_.longest);
      const float fresh = 1 / count;
      mean += fresh * (value - mean);
      moments[0] += fresh * (value.dot(value) - moments[0]);
      const cv::Vec3f off = value - mean;
      const float spread = std::max(0.0F, moments[0] - mean.dot(mean));
      const float density = 1 / (1 + off.dot(off) + spread);
      density_(y, x) = density;
      const float classified = count - static_cast<float>(parameters_.learning_frames);
      if (classified > 0) {
        const float variance = moments[2] - moments[1] * moments[1];
        const float deviation = std::max(parameters_.least_deviation, std::sqrt(std::max(0.0F, variance)));
        below(y, x) = std::max(0.0F, (moments[1] - density) / deviation);
      }
      const float rate = 1 / std::max(1.0F, classified + 1);
      moments[1] += rate * (density - moments[1]);
      moments[2] += rate * (density * density - moments[2]);
    }
  }
  return below;
}

void Aurora::reset() {
  registrar_.reset();
  density_.reset();
}

RivalScore Aurora::scoreFrame(const FrameInput& input) {
  RivalScore scored;
  const bool first = !registrar_.hasPrevious();
  const auto registration = registrar_.advance(input.grey);
  if (first) {
    density_.emplace(input.grey.size(), parameters_.density);
  } else if (!registration) {
    scored.status = DetectorStatus::kNoHomography;
    return scored;
  } else {
    density_->propagate(*registration);
    scored.background = *registration;
    scored.status = DetectorStatus::kGood;
  }
  cv::Mat3b smooth;
  cv::GaussianBlur(input.colour, smooth, {kSmoothPx, kSmoothPx}, 0);
  cv::Mat1f below = density_->update(smooth);
  cv::blur(below, below, {parameters_.average_px, parameters_.average_px});
  scored.score = gradedScore(below, kDeviations);
  return scored;
}

}  // namespace redbee
