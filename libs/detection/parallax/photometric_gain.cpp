#include "redbee/detection/parallax/photometric_gain.hpp"

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr int kWindow_px = 3;
// Grey levels^2: not below the images' quantization, and within the range of float.
constexpr double kLeastNoise2 = 1e-2, kMostNoise2 = 1e8;

/// Within 0 and `last`; 0 for a NaN, which std::clamp() would keep.
float inside(float coordinate, int last) {
  return std::min(std::max(0.0F, coordinate), static_cast<float>(last));
}

/// Bilinear; the border's pixels beyond the border.
float sample(const cv::Mat1b& image, const cv::Vec2f& at) {
  const float x = inside(at[0], image.cols - 1);
  const float y = inside(at[1], image.rows - 1);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, image.cols - 1);
  const float fx = x - static_cast<float>(left), fy = y - static_cast<float>(top);
  const uint8_t* above = image[top];
  const uint8_t* below = image[std::min(top + 1, image.rows - 1)];
  const auto along = [&](const uint8_t* row) {
    return static_cast<float>(row[left]) + fx * static_cast<float>(row[right] - row[left]);
  };
  return along(above) + fy * (along(below) - along(above));
}

/// Over the window; mirrored at the border.
cv::Vec3f meanAround(const cv::Mat3f& of, int x, int y) {
  constexpr int kHalf = kWindow_px / 2;
  const auto inside = [](int at, int size) {
    const int mirrored = std::abs(at);
    return std::max(std::min(mirrored, 2 * (size - 1) - mirrored), 0);
  };
  cv::Vec3d sum;
  for (int v = y - kHalf; v <= y + kHalf; ++v) {
    const cv::Vec3f* row = of[inside(v, of.rows)];
    for (int u = x - kHalf; u <= x + kHalf; ++u) sum += cv::Vec3d(row[inside(u, of.cols)]);
  }
  return sum * (1.0 / (kWindow_px * kWindow_px));
}

}  // namespace

cv::Mat1f photometricGain(const ImagePair& images, const cv::Mat1b& where, double noise) {
  const cv::Size size = images.current.size();
  cv::Mat1f gain(size, kNotCompared);
  const cv::Rect part = cv::boundingRect(where);
  if (part.empty()) return gain;
  cv::Mat3f squared(size);  // where needed: by the flow, the segment's nearest point, the ground
  constexpr int kBeside_px = kWindow_px / 2;
  const cv::Rect around = cv::Rect(part.x - kBeside_px, part.y - kBeside_px, part.width + 2 * kBeside_px,
                                   part.height + 2 * kBeside_px) &
                          cv::Rect({}, size);
  cv::Mat1b needed;
  cv::dilate(where(around), needed, cv::Mat1b::ones(kWindow_px, kWindow_px));
  for (int y = around.y; y < around.br().y; ++y) {
    if (cv::countNonZero(needed.row(y - around.y)) == 0) continue;
    const cv::Vec2f* const nearest = images.nearest(y);
    for (int x = around.x; x < around.br().x; ++x) {
      if (needed(y - around.y, x - around.x) == 0) continue;
      const cv::Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
      const cv::Vec2f ground = pixel - images.ground.at(pixel[0], pixel[1]);
      const auto now = static_cast<float>(images.current(y, x));
      const cv::Vec3f difference(now - sample(images.earlier, pixel + images.flow(y, x)),
                                 now - sample(images.earlier, ground - nearest[x]),
                                 now - sample(images.earlier, ground));
      squared(y, x) = difference.mul(difference);
    }
  }
  const auto noise2 = static_cast<float>(std::clamp(noise * noise, kLeastNoise2, kMostNoise2));
  for (int y = part.y; y < part.br().y; ++y) {
    for (int x = part.x; x < part.br().x; ++x) {
      if (where(y, x) == 0) continue;
      const cv::Vec3f mean = meanAround(squared, x, y);
      const float by_flow = mean[0];
      gain(y, x) = std::max(0.0F, std::min(mean[1], mean[2]) - by_flow) / (noise2 + by_flow);
    }
  }
  return gain;
}

}  // namespace redbee
