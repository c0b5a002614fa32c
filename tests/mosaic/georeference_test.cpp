#include "redbee/mosaic/georeference.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace redbee::test {
namespace {

/// Of a map whose x axis points 30 degrees north of east, seen from above, with 1.02 m per unit.
Eigen::Vector2d truth(const Eigen::Vector2d& on_map) {
  const double angle = 30 * M_PI / 180;
  const Eigen::Vector2d right(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d down(std::sin(angle), -std::cos(angle));
  return Eigen::Vector2d(465000, 5240000) + 1.02 * (on_map.x() * right + on_map.y() * down);
}

GroundTie tie(double x, double y, double sigma_m = 1) { return {{x, y}, truth({x, y}), sigma_m}; }

TEST(Georeference, IsTheSimilarityThatTheTiesAreOf) {
  const auto found = georeference({tie(0, 0), tie(40, 3), tie(-5, 70), tie(22, 22)});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->scale, 1.02, 1e-9);
  EXPECT_NEAR(found->residual_m, 0, 1e-6);
  EXPECT_LT((found->placeOf({13, -8}) - truth({13, -8})).norm(), 1e-6);
}

TEST(Georeference, WeighsEachTieByItsVariance) {
  GroundTie off = tie(20, 20, 10);
  off.place += Eigen::Vector2d(11, 0);
  // Four ties of sigma 1 and one of 10 that is 11 m off, in their middle: it moves all by 11 / 401.
  const auto found = georeference({tie(0, 0), tie(40, 0), tie(0, 40), tie(40, 40), off});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->placeOf({20, 20}).x() - truth({20, 20}).x(), 11.0 / 401, 1e-6);
  EXPECT_NEAR(found->scale, 1.02, 1e-9);
}

TEST(Georeference, NeedsTwoPlaces) {
  EXPECT_FALSE(georeference({}));
  EXPECT_FALSE(georeference({tie(1000, 2000)}));
  EXPECT_FALSE(georeference({tie(1000, 2000), tie(1000, 2000)}));
  EXPECT_TRUE(georeference({tie(1000, 2000), tie(1001, 2000)}));
}

}  // namespace
}  // namespace redbee::test
