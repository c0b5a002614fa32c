#include "redbee/geometry/camera.hpp"

#include <gtest/gtest.h>

namespace redbee::test {
namespace {

TEST(Camera, UndistortInvertsDistortOverTheImage) {
  // EuRoC's camera, whose distortion moves the corners by more than 100 px.
  const Camera camera({752,
                       480,
                       458.654,
                       457.296,
                       367.215,
                       248.375,
                       {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0}});
  for (int v = 0; v < 480; v += 60) {
    for (int u = 0; u < 752; u += 60) {
      const Eigen::Vector2d raw(u, v);
      EXPECT_LT((*camera.distort(*camera.undistort(raw)) - raw).norm(), 1e-9) << u << ' ' << v;
    }
  }
}

}  // namespace
}  // namespace redbee::test
