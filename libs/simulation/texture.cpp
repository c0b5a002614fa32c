#include "redbee/simulation/texture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <opencv2/imgproc.hpp>

namespace redbee::simulation {
namespace {

constexpr int kSize = 1024;  // texels, a power of two so that wrapping is a mask
constexpr int kSmallestLevel = 8;
constexpr int kMaxTaps = 4;
// Detail is kept this many octaves below the pixel's own limit: interpolation of the image must not lose
// it.
constexpr float kLevelBias = 0.6F;

cv::Mat wrapped(const cv::Mat& map, int margin) {
  cv::Mat larger;
  cv::copyMakeBorder(map, larger, margin, margin, margin, margin, cv::BORDER_WRAP);
  return larger;
}

/// Periodic value noise: random values on a grid of `cell` texels, interpolated by cubics.
cv::Mat valueNoise(int cell, cv::RNG& random) {
  constexpr int kMargin = 4;
  cv::Mat grid(kSize / cell, kSize / cell, CV_32F);
  random.fill(grid, cv::RNG::NORMAL, 0, 1);
  if (cell == 1) return grid;
  cv::Mat enlarged;
  cv::resize(wrapped(grid, kMargin), enlarged, {}, cell, cell, cv::INTER_CUBIC);
  return enlarged(cv::Rect(kMargin * cell, kMargin * cell, kSize, kSize)).clone();
}

struct Octave {
  int cell;       // texels
  double weight;  // standard deviation before normalisation
};

cv::Mat fractalNoise(std::initializer_list<Octave> octaves, cv::RNG& random) {
  cv::Mat sum = cv::Mat::zeros(kSize, kSize, CV_32F);
  for (const Octave& octave : octaves) sum += octave.weight * valueNoise(octave.cell, random);
  return sum;
}

cv::Mat normalised(const cv::Mat& map, double mean, double contrast) {
  cv::Scalar had_mean, had_deviation;
  cv::meanStdDev(map, had_mean, had_deviation);
  return (map - had_mean[0]) * (contrast / had_deviation[0]) + mean;
}

cv::Mat bodyMap(cv::RNG& random) {
  const cv::Mat patches = fractalNoise({{32, 1}, {16, 0.5}}, random);
  cv::Mat tones;
  cv::threshold(patches, tones, 0, 1.6, cv::THRESH_BINARY);
  cv::GaussianBlur(tones, tones, {}, 1.0);
  return tones + 0.35 * fractalNoise({{4, 1}, {8, 1}}, random);
}

void layBricks(cv::Mat& wall, cv::RNG& random) {
  constexpr int kBrickWidth = 32, kBrickHeight = 16;
  for (int row = 0; row * kBrickHeight < kSize; ++row) {
    const int shift = row % 2 * kBrickWidth / 2;
    for (int x = -shift; x < kSize; x += kBrickWidth) {
      const cv::Rect brick(x + 1, row * kBrickHeight + 1, kBrickWidth - 2, kBrickHeight - 2);
      cv::rectangle(wall, brick, cv::Scalar(0.6 + random.gaussian(0.7)), cv::FILLED);
    }
  }
}

void setWindows(cv::Mat& wall, cv::RNG& random) {
  constexpr int kSpacing = 256, kWidth = 104, kHeight = 136, kFrame = 6;
  for (int y = 60; y < kSize; y += kSpacing) {
    for (int x = 76; x < kSize; x += kSpacing) {
      const cv::Rect window(x, y, kWidth, kHeight);
      cv::rectangle(wall, window, cv::Scalar(2.6), cv::FILLED);
      const cv::Rect left(x + kFrame, y + kFrame, kWidth / 2 - kFrame * 3 / 2, kHeight - 2 * kFrame);
      const cv::Rect right(x + kWidth / 2 + kFrame / 2, y + kFrame, left.width, left.height);
      cv::rectangle(wall, left, cv::Scalar(-2.8 + random.uniform(0.0, 0.8)), cv::FILLED);
      cv::rectangle(wall, right, cv::Scalar(-2.8 + random.uniform(0.0, 0.8)), cv::FILLED);
    }
  }
}

cv::Mat facadeMap(cv::RNG& random) {
  cv::Mat wall(kSize, kSize, CV_32F, cv::Scalar(-0.8));
  layBricks(wall, random);
  setWindows(wall, random);
  cv::GaussianBlur(wall, wall, {}, 0.9);
  return wall + 0.5 * fractalNoise({{2, 0.5}, {4, 0.5}, {8, 0.6}, {64, 0.6}}, random);
}

cv::Mat makeMap(TextureKind kind, cv::RNG& random) {
  switch (kind) {
    case TextureKind::kFacade:
      return facadeMap(random);
    case TextureKind::kWater:
      return fractalNoise({{4, 0.4}, {8, 0.8}, {16, 1}, {32, 0.8}, {64, 0.5}}, random);
    case TextureKind::kBody:
      return bodyMap(random);
    case TextureKind::kGrass:
      break;
  }
  return fractalNoise({{2, 1}, {4, 1}, {8, 1}, {16, 0.9}, {32, 0.8}, {128, 0.7}}, random);
}

cv::Mat halved(const cv::Mat& map) {
  constexpr int kMargin = 4;
  cv::Mat blurred = wrapped(map, kMargin), half;
  cv::GaussianBlur(blurred, blurred, {}, 0.8);
  cv::resize(blurred(cv::Rect(kMargin, kMargin, map.cols, map.rows)), half, {}, 0.5, 0.5, cv::INTER_AREA);
  return half;
}

/// log2 of a positive float, linear between the powers of two: smooth enough to choose a mip level, and
/// cheap.
float roughLog2(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return static_cast<float>(bits) * (1.0F / (1U << 23)) - 127.0F;
}

int floorToInt(float x) {
  const int truncated = static_cast<int>(x);
  return truncated - (x < static_cast<float>(truncated) ? 1 : 0);
}

}  // namespace

Texture::Texture(const Material& material) : texels_per_m_(static_cast<float>(1 / material.texel_m)) {
  cv::RNG random(0x9E3779B97F4A7C15ULL ^ (static_cast<std::uint64_t>(material.seed) << 8U));
  cv::Mat map = normalised(makeMap(material.kind, random), material.mean, material.contrast);
  for (; map.cols >= kSmallestLevel; map = halved(map)) {
    cv::Mat_<uchar> level;
    map.convertTo(level, CV_8U);
    levels_.push_back(level);
  }
}

float Texture::sampleLevel(int level, float u_m, float v_m) const {
  const cv::Mat_<uchar>& map = levels_[static_cast<size_t>(level)];
  const int mask = map.cols - 1;
  const float scale = texels_per_m_ / static_cast<float>(1 << level);
  // Texel i covers [i, i + 1]; its value sits in the middle.
  const float x = u_m * scale - 0.5F, y = v_m * scale - 0.5F;
  const int left = floorToInt(x), top = floorToInt(y);
  const float fx = x - static_cast<float>(left), fy = y - static_cast<float>(top);
  const uchar* row = map.ptr<uchar>(top & mask);
  const uchar* next_row = map.ptr<uchar>((top + 1) & mask);
  const int x0 = left & mask, x1 = (left + 1) & mask;
  const float upper = static_cast<float>(row[x0]) + fx * static_cast<float>(row[x1] - row[x0]);
  const float lower = static_cast<float>(next_row[x0]) + fx * static_cast<float>(next_row[x1] - next_row[x0]);
  return upper + fy * (lower - upper);
}

float Texture::sampleBetween(float level, float u_m, float v_m) const {
  const int last = static_cast<int>(levels_.size()) - 1;
  if (level <= 0) return sampleLevel(0, u_m, v_m);
  if (level >= static_cast<float>(last)) return sampleLevel(last, u_m, v_m);
  const int fine = static_cast<int>(level);
  const float fraction = level - static_cast<float>(fine);
  const float value = sampleLevel(fine, u_m, v_m);
  return value + fraction * (sampleLevel(fine + 1, u_m, v_m) - value);
}

float Texture::sample(float u_m, float v_m, const Footprint& foot) const {
  const float along_x = std::sqrt(foot.du_dx * foot.du_dx + foot.dv_dx * foot.dv_dx);
  const float along_y = std::sqrt(foot.du_dy * foot.du_dy + foot.dv_dy * foot.dv_dy);
  const bool y_is_longer = along_y > along_x;
  const float longer = y_is_longer ? along_y : along_x;
  const float shorter = std::max(y_is_longer ? along_x : along_y, 1e-9F);
  const int taps = std::clamp(static_cast<int>(std::ceil(longer / shorter - 0.01F)), 1, kMaxTaps);
  const float width = std::max(longer / static_cast<float>(taps), shorter);
  const float level = roughLog2(width * texels_per_m_) + kLevelBias;
  if (taps == 1) return sampleBetween(level, u_m, v_m);

  const float du = (y_is_longer ? foot.du_dy : foot.du_dx) / static_cast<float>(taps);
  const float dv = (y_is_longer ? foot.dv_dy : foot.dv_dx) / static_cast<float>(taps);
  float sum = 0;
  for (int tap = 0; tap < taps; ++tap) {
    const float offset = static_cast<float>(tap) - 0.5F * static_cast<float>(taps - 1);
    sum += sampleBetween(level, u_m + offset * du, v_m + offset * dv);
  }
  return sum / static_cast<float>(taps);
}

}  // namespace redbee::simulation
