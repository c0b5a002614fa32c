#include "redbee/detection/appearance/appearance_kernels.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/appearance/background_warp.hpp"
#include "redbee/detection/appearance/shadow_test.hpp"
#include "tests/support/instruction_sets.hpp"

namespace redbee {
namespace {

const cv::Size kSize(45, 7);  // no multiple of any vector
constexpr SurfaceReset kReset{true, 6.25F};

template <typename Map>
Map randomMap(uint64_t seed, double low, double high) {
  Map map(kSize);
  cv::RNG(seed).fill(map, cv::RNG::UNIFORM, low, high);
  return map;
}

class AppearanceKernels : public test::WithInstructions {
 protected:
  cv::Mat4f image_ = randomMap<cv::Mat4f>(1, 0, 255), model_ = randomMap<cv::Mat4f>(2, 0, 255);
  cv::Mat2f speed_ = randomMap<cv::Mat2f>(3, 0.01, 3);
  cv::Mat1f learned_speed_ = randomMap<cv::Mat1f>(4, 0, 6), shadow_ = randomMap<cv::Mat1f>(5, 0, 1);
  cv::Mat1b age_ = randomMap<cv::Mat1b>(6, 0, 8);
};
REDBEE_WITH_INSTRUCTIONS(AppearanceKernels);

float meanSquare(const cv::Vec4f& a, const cv::Vec4f& b) {
  const cv::Vec4f d = a - b;
  return ((d[0] * d[0] + d[2] * d[2]) + d[1] * d[1]) * (1.0F / 3);
}

float movedAway(float learned, const cv::Vec2f& speed) {
  const float slower = std::max(0.0F, learned - speed[0]);
  return slower * slower / (slower * slower + kReset.sigmas2 * speed[1]);
}

TEST_P(AppearanceKernels, DifferenceIsTheScalarOne) {
  constexpr float kNoise2 = 400, kEdge2 = 2.25F;
  cv::Mat1f found(kSize);
  const auto rowOf = [&](int y) { return std::clamp(y, 0, kSize.height - 1); };
  for (int y = 0; y < kSize.height; ++y) {
    const auto model = [&](int of) { return model_.ptr<float>(rowOf(of)); };
    differenceRow({static_cast<size_t>(kSize.width),
                   image_.ptr<float>(y),
                   {model(y - 1), model(y), model(y + 1)},
                   shadow_[y],
                   speed_.ptr<float>(y),
                   learned_speed_[y],
                   age_[y],
                   found[y]},
                  kNoise2, kEdge2, kReset);
    for (int x = 0; x < kSize.width; ++x) {
      const cv::Vec4f& known = model_(y, x);
      const auto column = [&](int of) { return std::clamp(of, 0, kSize.width - 1); };
      const float slope = 0.25F * (meanSquare(model_(y, column(x + 1)), model_(y, column(x - 1))) +
                                   meanSquare(model_(rowOf(y + 1), x), model_(rowOf(y - 1), x)));
      const float d2 = meanSquare(image_(y, x), known);
      const float doubt = known[3] + kNoise2 + kEdge2 * slope;
      const float expected =
          d2 / (d2 + doubt) * (1 - shadow_(y, x)) * (1 - movedAway(learned_speed_(y, x), speed_(y, x)));
      ASSERT_EQ(found(y, x), age_(y, x) == 0 ? 0 : expected) << x << ' ' << y;
    }
  }
}

TEST_P(AppearanceKernels, LearningIsTheScalarOne) {
  RatesByAge mean_rates, variance_rates;
  for (size_t i = 0; i < mean_rates.size(); ++i) {
    mean_rates[i] = 1 / (static_cast<float>(i) + 1);
    variance_rates[i] = 2 / (static_cast<float>(i) + 3);
  }
  age_(0, 3) = 255;
  cv::Mat4f model = model_.clone();
  cv::Mat1f learned = learned_speed_.clone();
  cv::Mat1b age = age_.clone();
  for (int y = 0; y < kSize.height; ++y) {
    learnRow({static_cast<size_t>(kSize.width), image_.ptr<float>(y), shadow_[y], speed_.ptr<float>(y),
              model.ptr<float>(y), learned[y], age[y]},
             mean_rates, variance_rates, kReset);
    for (int x = 0; x < kSize.width; ++x) {
      cv::Vec4f known = model_(y, x);
      const cv::Vec2f& speed = speed_(y, x);
      const float was = learned_speed_(y, x);
      const int old = movedAway(was, speed) > 0.5F ? 0 : age_(y, x);
      const float rate =
          mean_rates[static_cast<size_t>(old)] * (old < 3 ? 1 : 1 - (1 - 0.05F) * shadow_(y, x));
      const float change = std::min(meanSquare(image_(y, x), known), 1000.0F) - known[3];
      const float variance = old == 0 ? 400 : known[3] + variance_rates[static_cast<size_t>(old)] * change;
      for (int i = 0; i < 3; ++i) known[i] += rate * (image_(y, x)[i] - known[i]);
      known[3] = variance;
      ASSERT_EQ(model(y, x), known) << x << ' ' << y;
      ASSERT_EQ(learned(y, x), old == 0 ? speed[0] : was + rate * (speed[0] - was));
      ASSERT_EQ(age(y, x), std::min(old + 1, 255));
    }
  }
}

TEST_P(AppearanceKernels, ShadowsAreTheScalarOnes) {
  constexpr double kNoise = 8;
  const cv::Mat4b shaded = 0.6 * model_ + 0.02 * image_;
  cv::Mat3f products = cv::Mat3f::zeros(kSize), sums;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      for (int i = 0; i < 3; ++i) {
        const float p = shaded(y, x)[i], b = model_(y, x)[i];
        products(y, x) += cv::Vec3f(p * p, p * b, b * b);
      }
    }
  }
  cv::boxFilter(products, sums, -1, {3, 3}, {-1, -1}, false, cv::BORDER_REPLICATE);
  FloatRows rows(shaded);
  ShadowTest shadows(rows, model_, kNoise);
  float most = 0;
  for (int y = 0; y < kSize.height; ++y) {
    const std::vector<float>& row = shadows.row(y);
    for (int x = 0; x < kSize.width; ++x) {
      const float scale = sums(y, x)[1] / std::max(sums(y, x)[2], 1.0F);
      const float dark = std::clamp((scale - 0.4F) / 0.1F, 0.0F, 1.0F);
      const float light = std::clamp((0.95F - scale) / 0.05F, 0.0F, 1.0F);
      const float misfit =
          std::max(0.0F, sums(y, x)[0] - scale * sums(y, x)[1]) / 27 / static_cast<float>(kNoise * kNoise);
      // The sums are in another order, and their difference is small.
      ASSERT_NEAR(row[static_cast<size_t>(x)], dark * light / (1 + misfit * misfit), 1e-3) << x << ' ' << y;
      most = std::max(most, row[static_cast<size_t>(x)]);
    }
  }
  EXPECT_GT(most, 0.5);
}

TEST_P(AppearanceKernels, WarpIsTheScalarOne) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H(0, 2) = 2.4;
  H(1, 2) = -1.2;
  const BackgroundMaps maps{model_, learned_speed_, age_};
  BackgroundMaps warped;
  warpBackground(maps, SceneMotion(H, std::nullopt, Eigen::Matrix3d::Identity()), warped);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double u = x - H(0, 2), v = y - H(1, 2);
      const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
      const bool is_inside = left >= 0 && top >= 0 && left < kSize.width - 1 && top < kSize.height - 1;
      if (!is_inside) {
        ASSERT_EQ(warped.age(y, x), 0);
        ASSERT_EQ(warped.model(y, x), cv::Vec4f::all(0));
        continue;
      }
      const auto fx = static_cast<float>(u - left), fy = static_cast<float>(v - top);
      const cv::Vec4f upper = model_(top, left) * (1 - fx) + model_(top, left + 1) * fx;
      const cv::Vec4f lower = model_(top + 1, left) * (1 - fx) + model_(top + 1, left + 1) * fx;
      ASSERT_LT(cv::norm(warped.model(y, x) - (upper * (1 - fy) + lower * fy)), 0.01) << x << ' ' << y;
      ASSERT_EQ(warped.age(y, x), age_(top + (fy > 0.5F), left + (fx > 0.5F)));
      ASSERT_EQ(warped.speed(y, x), learned_speed_(top + (fy > 0.5F), left + (fx > 0.5F)));
    }
  }
}

}  // namespace
}  // namespace redbee
