#include "redbee/detection/appearance/shadow_test.hpp"

#include <Eigen/Core>
#include <algorithm>

namespace redbee {
namespace {

constexpr int kColours = 3;
constexpr int kWindow = 3;  // px, both ways
// Brightness of a shadow relative to the lit surface, in gamma-encoded grey levels: skylight is 0.1 to 0.5 of
// the total light, which gives 0.35 to 0.75.
constexpr float kDarkest = 0.4F;
constexpr float kDarkestRamp = 0.1F;
constexpr float kLightest = 0.95F;
constexpr float kLightestRamp = 0.05F;

void sumThree(const std::vector<float>& of, std::vector<float>& to) {
  const size_t n = of.size();
  if (n < 2) {
    to = of;
    return;
  }
  to[0] = 2 * of[0] + of[1];
  for (size_t x = 1; x + 1 < n; ++x) to[x] = of[x - 1] + of[x] + of[x + 1];
  to[n - 1] = of[n - 2] + 2 * of[n - 1];
}

}  // namespace

ShadowTest::ShadowTest(const cv::Mat4f& image, const cv::Mat4f& background, double noise)
    : image_(image),
      background_(background),
      noise_variance_(static_cast<float>(noise * noise)),
      shadow_(static_cast<size_t>(image.cols)) {
  for (Sums* sums : {&products_, &rows_[0], &rows_[1], &rows_[2]}) {
    for (auto* of : {&sums->pp, &sums->pb, &sums->bb}) of->resize(static_cast<size_t>(image.cols));
  }
}

void ShadowTest::add(int y) {
  const float* now = image_.ptr<float>(y);
  const float* known = background_.ptr<float>(y);
  for (int x = 0; x < image_.cols; ++x) {
    const Eigen::Map<const Eigen::Array3f> p(now + 4 * x), b(known + 4 * x);
    const auto i = static_cast<size_t>(x);
    products_.pp[i] = p.square().sum();
    products_.pb[i] = (p * b).sum();
    products_.bb[i] = b.square().sum();
  }
  Sums& row = rows_[y % kWindow];
  sumThree(products_.pp, row.pp);
  sumThree(products_.pb, row.pb);
  sumThree(products_.bb, row.bb);
}

float ShadowTest::score(float pp, float pb, float bb) const {
  const float scale = pb / std::max(bb, 1.0F);
  const float dark = std::clamp((scale - kDarkest) / kDarkestRamp, 0.0F, 1.0F);
  const float light = std::clamp((kLightest - scale) / kLightestRamp, 0.0F, 1.0F);
  const float left = std::max(0.0F, pp - scale * pb) / (kColours * kWindow * kWindow);
  const float misfit = left / noise_variance_;
  return dark * light / (1 + misfit * misfit);
}

const std::vector<float>& ShadowTest::row(int y) {
  const int last = image_.rows - 1;
  for (; next_ <= std::min(y + 1, last); ++next_) add(next_);
  const Sums& above = rows_[std::max(y - 1, 0) % kWindow];
  const Sums& here = rows_[y % kWindow];
  const Sums& below = rows_[std::min(y + 1, last) % kWindow];
  for (size_t x = 0; x < shadow_.size(); ++x) {
    shadow_[x] = score(above.pp[x] + here.pp[x] + below.pp[x], above.pb[x] + here.pb[x] + below.pb[x],
                       above.bb[x] + here.bb[x] + below.bb[x]);
  }
  return shadow_;
}

}  // namespace redbee
