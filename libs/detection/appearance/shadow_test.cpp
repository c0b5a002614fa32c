#include "redbee/detection/appearance/shadow_test.hpp"

#include <algorithm>

namespace redbee {
namespace {

constexpr int kWindow = 3;  // px, both ways

}  // namespace

ShadowTest::ShadowTest(FloatRows& image, const cv::Mat4f& background, double noise)
    : image_(image),
      background_(background),
      noise_variance_(static_cast<float>(noise * noise)),
      products_(3 * static_cast<size_t>(background.cols)),
      shadow_(static_cast<size_t>(background.cols)) {
  for (Sums& sums : rows_) sums.values.resize(products_.size());
}

void ShadowTest::add(int y) {
  const size_t width = shadow_.size();
  sumShadowRow(image_(y), background_.ptr<float>(y), width, products_.data(), rows_[y % kWindow].of(width));
}

const std::vector<float>& ShadowTest::row(int y) {
  const int last = background_.rows - 1;
  const size_t width = shadow_.size();
  for (; next_ <= std::min(y + 1, last); ++next_) add(next_);
  const auto sums = [&](int of) { return rows_[std::clamp(of, 0, last) % kWindow].of(width); };
  const ShadowSums rows[3] = {sums(y - 1), sums(y), sums(y + 1)};
  scoreShadowRow(rows, width, noise_variance_, shadow_.data());
  return shadow_;
}

}  // namespace redbee
