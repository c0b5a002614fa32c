#include "redbee/detection/rivals/mcd.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/rivals/graded_score.hpp"

namespace redbee {
namespace {

constexpr int kMedianPx = 5;
constexpr float kFirstVariance = 400;
constexpr float kLeastVariance = 100;
constexpr float kGreatestAge = 10;
constexpr float kAgeDecay = 0.001F;
constexpr float kNoiseVariance = 2500;  // variance above which age decays
constexpr float kMatch = 2;             // squared sigmas
constexpr float kForegroundSigmas = 2;  // the square root of the authors' 4
constexpr float kClassifiedFromAge = 1;
constexpr int kAveragePx = 21;
constexpr float kDecisionFraction = 0.26F;

float squared(float x) { return x * x; }

bool matches(const GreyGaussian& model, float mean) {
  return squared(mean - model.mean) < kMatch * model.variance;
}

void learn(GreyGaussian& model, float mean, float least, float greatest) {
  const float kept = model.age / (model.age + 1);
  const bool is_new = model.age <= 0;
  model.mean = model.age < 1 ? mean : kept * model.mean + (1 - kept) * mean;
  const float observed = std::max(squared(least - model.mean), squared(greatest - model.mean));
  model.variance =
      is_new ? std::max(observed, kFirstVariance) : kept * model.variance + (1 - kept) * observed;
  model.variance = std::max(model.variance, kLeastVariance);
  model.age = std::min(model.age + 1, kGreatestAge);
}

struct BlockPixels {
  float mean, least, greatest;
};

BlockPixels pixelsOf(const cv::Mat1b& grey, int row, int column) {
  constexpr int kSide = Mcd::kBlockPx;
  int sum = 0;
  int least = 255;
  int greatest = 0;
  for (int y = row * kSide; y < (row + 1) * kSide; ++y) {
    const auto* pixel = grey[y] + column * kSide;
    for (int x = 0; x < kSide; ++x) {
      sum += pixel[x];
      least = std::min<int>(least, pixel[x]);
      greatest = std::max<int>(greatest, pixel[x]);
    }
  }
  return {static_cast<float>(sum) / (kSide * kSide), static_cast<float>(least), static_cast<float>(greatest)};
}

}  // namespace

GreyGaussian blendGaussians(const std::array<GreyGaussian, 4>& models, const std::array<float, 4>& weights) {
  float total = 0;
  GreyGaussian blend{0, 0, 0};
  for (size_t i = 0; i < models.size(); ++i) {
    total += weights[i];
    blend.mean += weights[i] * models[i].mean;
    blend.age += weights[i] * models[i].age;
  }
  if (total <= 0) return {};
  blend.mean /= total;
  blend.age /= total;
  for (size_t i = 0; i < models.size(); ++i) {
    blend.variance += weights[i] / total * (models[i].variance + squared(blend.mean - models[i].mean));
  }
  blend.variance = std::max(blend.variance, kLeastVariance);
  blend.age *= std::exp(-kAgeDecay * std::max(0.0F, blend.variance - kNoiseVariance));
  blend.age = std::min(blend.age, kGreatestAge);
  return blend;
}

BlockBackground updateDualModel(DualModel& model, float mean, float least, float greatest) {
  if (model[1].age > 0 && model[1].age >= model[0].age) {
    model[0] = model[1];
    model[1] = {mean, kFirstVariance, 0};
  }
  const GreyGaussian before = model[0];
  if (matches(model[0], mean)) {
    learn(model[0], mean, least, greatest);
  } else {
    if (!matches(model[1], mean)) model[1] = {mean, kFirstVariance, 0};
    learn(model[1], mean, least, greatest);
  }
  return {model[0].mean, before.variance, before.age > kClassifiedFromAge};
}

void Mcd::reset() {
  registrar_.reset();
  models_.clear();
}

RivalScore Mcd::scoreFrame(const FrameInput& input) {
  cv::Mat1b grey;
  cv::medianBlur(input.grey, grey, kMedianPx);
  RivalScore scored;
  const bool first = !registrar_.hasPrevious();
  const auto registration = registrar_.advance(grey);
  if (first) {
    blocks_ = grey.size() / kBlockPx;
    models_.assign(static_cast<size_t>(blocks_.area()), DualModel{});
  } else if (!registration) {
    scored.status = DetectorStatus::kNoHomography;
    return scored;
  } else {
    propagate(*registration);
    scored.status = DetectorStatus::kGood;
    scored.background = *registration;
  }
  scored.score = averagedScore(updateAndScore(grey), kAveragePx, kDecisionFraction);
  return scored;
}

GreyGaussian Mcd::modelAt(size_t which, double column, double row) const {
  const int left = static_cast<int>(std::floor(column));
  const int top = static_cast<int>(std::floor(row));
  const auto right_fraction = static_cast<float>(column - left);
  const auto lower_fraction = static_cast<float>(row - top);
  std::array<GreyGaussian, 4> around{};
  std::array<float, 4> weights{};
  for (size_t i = 0; i < 4; ++i) {
    const int c = left + static_cast<int>(i % 2);
    const int r = top + static_cast<int>(i / 2);
    if (c < 0 || r < 0 || c >= blocks_.width || r >= blocks_.height) continue;
    around[i] = model(r, c)[which];
    weights[i] = (i % 2 == 0 ? 1 - right_fraction : right_fraction) *
                 (i / 2 == 0 ? 1 - lower_fraction : lower_fraction);
  }
  return blendGaussians(around, weights);
}

void Mcd::propagate(const cv::Matx33d& H) {
  constexpr double kCentre = 0.5 * (kBlockPx - 1);
  const cv::Matx33d back = H.inv();
  // The authors reset the outermost blocks, where neighbours are missing.
  const cv::Rect2d inner(0.5, 0.5, blocks_.width - 2, blocks_.height - 2);
  std::vector<DualModel> warped(models_.size());
  size_t block = 0;
  for (int row = 0; row < blocks_.height; ++row) {
    for (int column = 0; column < blocks_.width; ++column, ++block) {
      const cv::Vec3d at = back * cv::Vec3d(column * kBlockPx + kCentre, row * kBlockPx + kCentre, 1);
      const double x = (at[0] / at[2] - kCentre) / kBlockPx;
      const double y = (at[1] / at[2] - kCentre) / kBlockPx;
      if (!(at[2] > 0 && inner.contains(cv::Point2d(x, y)))) continue;
      for (size_t which = 0; which < 2; ++which) warped[block][which] = modelAt(which, x, y);
    }
  }
  models_ = std::move(warped);
}

cv::Mat1b Mcd::updateAndScore(const cv::Mat1b& grey) {
  cv::Mat1b score = cv::Mat1b::zeros(grey.size());
  for (int row = 0; row < blocks_.height; ++row) {
    for (int column = 0; column < blocks_.width; ++column) {
      const BlockPixels block = pixelsOf(grey, row, column);
      const BlockBackground background =
          updateDualModel(model(row, column), block.mean, block.least, block.greatest);
      if (!background.classifies) continue;
      const float unit = 1 / (kForegroundSigmas * std::sqrt(background.variance));
      for (int y = row * kBlockPx; y < (row + 1) * kBlockPx; ++y) {
        const auto* pixel = grey[y] + column * kBlockPx;
        auto* to = score[y] + column * kBlockPx;
        for (int x = 0; x < kBlockPx; ++x) to[x] = gradedScore(std::abs(pixel[x] - background.mean) * unit);
      }
    }
  }
  return score;
}

}  // namespace redbee
