#include "redbee/detection/two_planes/gaussian_mixture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

// Zivkovic's published constants, in grey levels squared where they are variances.
constexpr float kBackgroundFraction = 0.9F;
constexpr float kComplexityPrior = 0.05F;
constexpr float kMatchThreshold = 9.0F;
constexpr float kInitialVariance = 15.0F;
constexpr float kMinVariance = 4.0F;
constexpr float kMaxVariance = 75.0F;

}  // namespace

GaussianMixture::GaussianMixture(cv::Size size, int history_frames, double threshold)
    : size_(size),
      history_(std::max(history_frames, 1)),
      threshold_(static_cast<float>(threshold)),
      pixels_(static_cast<size_t>(size.area())) {}

cv::Mat1b GaussianMixture::update(const cv::Mat1b& grey, const cv::Mat1b& valid) {
  cv::Mat1b foreground = cv::Mat1b::zeros(size_);
  for (int y = 0; y < size_.height; ++y) {
    const uint8_t* value = grey[y];
    const uint8_t* is_valid = valid[y];
    uint8_t* out = foreground[y];
    Pixel* row = &pixels_[static_cast<size_t>(y) * static_cast<size_t>(size_.width)];
    for (int x = 0; x < size_.width; ++x) {
      if (is_valid[x] != 0 && !learn(row[x], value[x])) out[x] = 255;
    }
  }
  return foreground;
}

bool GaussianMixture::learn(Pixel& pixel, float value) const {
  pixel.age = static_cast<uint16_t>(std::min(pixel.age + 1, history_));
  // The weights always adapt at the rate of the history: a faster start would absorb a moving object within
  // three frames. Mean and variance start as plain averages, so that new pixels converge quickly.
  const float rate = 1.0F / static_cast<float>(history_);
  const float least_gain = 1.0F / static_cast<float>(pixel.age);
  const float prune = rate * kComplexityPrior;
  bool background = false;
  bool matched = false;
  float seen_weight = 0;
  for (int i = 0; i < kGaussians && pixel.gaussians[i].weight > 0; ++i) {
    Gaussian& gaussian = pixel.gaussians[i];
    gaussian.weight = (1 - rate) * gaussian.weight - prune;
    int place = i;
    if (!matched) {
      const float difference = value - gaussian.mean;
      const float distance2 = difference * difference;
      background =
          background || (seen_weight < kBackgroundFraction && distance2 < threshold_ * gaussian.variance);
      if (distance2 < kMatchThreshold * gaussian.variance) {
        matched = true;
        gaussian.weight += rate;
        const float gain = std::min(std::max(rate / gaussian.weight, least_gain), 1.0F);
        gaussian.mean += gain * difference;
        gaussian.variance = std::clamp(gaussian.variance + gain * (distance2 - gaussian.variance),
                                       kMinVariance, kMaxVariance);
        for (; place > 0 && pixel.gaussians[place].weight > pixel.gaussians[place - 1].weight; --place) {
          std::swap(pixel.gaussians[place], pixel.gaussians[place - 1]);
        }
      }
    }
    Gaussian& placed = pixel.gaussians[place];
    placed.weight = std::max(placed.weight, 0.0F);
    seen_weight += placed.weight;
  }
  if (!matched) addGaussian(pixel, value, rate);
  float total = 0;
  for (const Gaussian& gaussian : pixel.gaussians) total += gaussian.weight;
  for (Gaussian& gaussian : pixel.gaussians) gaussian.weight /= total;
  return background;
}

void GaussianMixture::addGaussian(Pixel& pixel, float value, float rate) const {
  Gaussian& last = pixel.gaussians.back();
  last = {rate, value, kInitialVariance};
  for (int place = kGaussians - 1; place > 0; --place) {
    if (pixel.gaussians[place].weight <= pixel.gaussians[place - 1].weight) break;
    std::swap(pixel.gaussians[place], pixel.gaussians[place - 1]);
  }
}

cv::Mat1b GaussianMixture::unknown(int frames) const {
  cv::Mat1b unknown(size_);
  for (size_t i = 0; i < pixels_.size(); ++i) unknown.data[i] = pixels_[i].age < frames ? 255 : 0;
  return unknown;
}

void GaussianMixture::move(const Eigen::Matrix3d& H) {
  // OpenCV remaps no 32-bit integers; floats represent every index of an image below 2^24 pixels exactly.
  cv::Mat1f index(size_);
  for (int i = 0; i < size_.area(); ++i) index(i / size_.width, i % size_.width) = static_cast<float>(i + 1);
  const cv::Mat1f source = warpToCurrent(index, H, cv::INTER_NEAREST);
  std::vector<Pixel> moved(pixels_.size());
  for (int y = 0; y < size_.height; ++y) {
    const float* from = source[y];
    Pixel* to = &moved[static_cast<size_t>(y) * static_cast<size_t>(size_.width)];
    for (int x = 0; x < size_.width; ++x) {
      if (from[x] > 0) to[x] = pixels_[static_cast<size_t>(from[x]) - 1];
    }
  }
  pixels_ = std::move(moved);
}

}  // namespace redbee
