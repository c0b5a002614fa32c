#include "redbee/detection/appearance/appearance_model.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "redbee/detection/appearance/background_warp.hpp"
#include "redbee/detection/appearance/shadow_test.hpp"

namespace redbee {
namespace {

constexpr int kColours = 3;
constexpr float kFirstVariance = 400;  // after the first image: the pixel may lie on an edge
constexpr float kMostVariance = 1000;  // a passing object must not raise the background's variance
constexpr int kTrusted = 3;            // images after which moving pixels are learned slowly
constexpr double kVarianceSpan_s = 0.4;
constexpr float kMovingFraction = 0.05F;  // of the learning rate, where the pixel certainly moves
constexpr float kSurelyMovedAway = 0.5F;  // above this the pixel's model is reset

using Pixel = Eigen::Map<Eigen::Array4f>;
using ConstPixel = Eigen::Map<const Eigen::Array4f>;

/// Mean square over the three colour channels.
float meanSquare(const Eigen::Array4f& difference) {
  const Eigen::Array4f counted = difference * Eigen::Array4f(1, 1, 1, 0);
  return counted.square().sum() * (1.0F / kColours);
}

/// Squared slope of the mean colour about pixel (x, y), of one channel [grey levels^2 a px^2].
class Slope {
 public:
  Slope(const cv::Mat4f& model, int y)
      : here_(model.ptr<float>(y)),
        above_(model.ptr<float>(std::max(y - 1, 0))),
        below_(model.ptr<float>(std::min(y + 1, model.rows - 1))),
        last_(model.cols - 1) {}

  float squared(int x) const {
    const int left = 4 * std::max(x - 1, 0), right = 4 * std::min(x + 1, last_);
    const Eigen::Array4f across = ConstPixel(here_ + right) - ConstPixel(here_ + left);
    const Eigen::Array4f down = ConstPixel(below_ + 4 * x) - ConstPixel(above_ + 4 * x);
    return 0.25F * (meanSquare(across) + meanSquare(down));
  }

 private:
  const float* here_;
  const float* above_;
  const float* below_;
  int last_;
};

/// 1 / (age + 1), at least `slowest`.
std::array<float, 256> ratesByAge(double slowest) {
  std::array<float, 256> rates{};
  for (size_t age = 0; age < rates.size(); ++age) {
    const double rate = std::max(1.0 / (static_cast<double>(age) + 1), slowest);
    rates[age] = static_cast<float>(std::min(rate, 1.0));
  }
  return rates;
}

}  // namespace

void AppearanceModel::reset() {
  model_.release();
  speed_.release();
  age_.release();
}

void AppearanceModel::propagate(const SceneMotion& scene) {
  if (model_.empty()) return;
  const BackgroundMaps warped = warpBackground({model_, speed_, age_}, scene);
  model_ = warped.model;
  speed_ = warped.speed;
  age_ = warped.age;
}

/// 0..1: confidence that the modelled surface has moved away and uncovered a slower one.
float AppearanceModel::movedAway(float learned_speed, const cv::Vec2f& speed) const {
  if (!parameters_.use_surface_reset) return 0;
  const auto sigmas = static_cast<float>(evidence_sigmas_);
  const float slower = std::max(0.0F, learned_speed - speed[0]);
  const float gone = slower * slower;
  return gone / (gone + sigmas * sigmas * speed[1]);
}

cv::Mat1f AppearanceModel::appearanceDifference(const cv::Mat4f& image, const SurfaceSpeed& speed) const {
  cv::Mat1f evidence = cv::Mat1f::zeros(image.size());
  if (model_.empty()) return evidence;
  const auto noise2 = static_cast<float>(parameters_.noise * parameters_.noise);
  const double edge_px = parameters_.edge_tolerance_px / std::max(parameters_.downscale, 1);
  const auto edge2 = static_cast<float>(edge_px * edge_px);
  std::optional<ShadowTest> shadows;
  if (shadow_.enabled) shadows.emplace(image, model_, shadow_.noise);
  const std::vector<float> none(static_cast<size_t>(image.cols), 0.0F);
  for (int y = 0; y < image.rows; ++y) {
    const std::vector<float>& shadow = shadows ? shadows->row(y) : none;
    const Slope slope(model_, y);
    const float* now = image.ptr<float>(y);
    const float* known = model_.ptr<float>(y);
    const cv::Vec2f* is = speed[y];
    const float* was = speed_[y];
    const uint8_t* age = age_[y];
    float* to = evidence[y];
    for (int x = 0; x < image.cols; ++x) {
      if (age[x] == 0) continue;
      const float d2 = meanSquare(ConstPixel(now + 4 * x) - ConstPixel(known + 4 * x));
      const float doubt = known[4 * x + kColours] + noise2 + edge2 * slope.squared(x);
      const float foreign = d2 / (d2 + doubt);
      to[x] = foreign * (1 - shadow[static_cast<size_t>(x)]) * (1 - movedAway(was[x], is[x]));
    }
  }
  return evidence;
}

void AppearanceModel::learn(const cv::Mat4f& image, const cv::Mat1f& moving, const SurfaceSpeed& speed,
                            double elapsed_s) {
  if (model_.empty()) {
    model_ = cv::Mat4f::zeros(image.size());
    speed_ = cv::Mat1f::zeros(image.size());
    age_ = cv::Mat1b::zeros(image.size());
  }
  const auto mean_rates = ratesByAge(elapsed_s / parameters_.span_s);
  const auto variance_rates = ratesByAge(elapsed_s / kVarianceSpan_s);
  for (int y = 0; y < image.rows; ++y) {
    const float* now = image.ptr<float>(y);
    const float* moves = moving[y];
    const cv::Vec2f* is = speed[y];
    float* was = speed_[y];
    float* known = model_.ptr<float>(y);
    uint8_t* age = age_[y];
    for (int x = 0; x < image.cols; ++x) {
      if (movedAway(was[x], is[x]) > kSurelyMovedAway) age[x] = 0;
      const Eigen::Array4f difference = ConstPixel(now + 4 * x) - ConstPixel(known + 4 * x);
      const float keep = age[x] < kTrusted ? 1 : 1 - (1 - kMovingFraction) * moves[x];
      const float rate = mean_rates[age[x]] * keep;
      const float variance = known[4 * x + kColours];
      const float change = std::min(meanSquare(difference), kMostVariance) - variance;
      Pixel(known + 4 * x) += rate * difference;
      known[4 * x + kColours] = age[x] == 0 ? kFirstVariance : variance + variance_rates[age[x]] * change;
      was[x] = age[x] == 0 ? is[x][0] : was[x] + rate * (is[x][0] - was[x]);
      if (age[x] < 255) ++age[x];
    }
  }
}

}  // namespace redbee
