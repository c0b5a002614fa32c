#include "redbee/fusion/overlap.hpp"

namespace redbee {

double overlap(const Eigen::Matrix3d& H, int width, int height) {
  constexpr int kGrid = 16;  // px
  int inside = 0;
  int all = 0;
  for (int v = kGrid / 2; v < height; v += kGrid) {
    for (int u = kGrid / 2; u < width; u += kGrid, ++all) {
      const Eigen::Vector3d x = H * Eigen::Vector3d(u, v, 1);
      if (x.z() <= 0) continue;
      const double x_px = x.x() / x.z();
      const double y_px = x.y() / x.z();
      inside += x_px >= -0.5 && x_px <= width - 0.5 && y_px >= -0.5 && y_px <= height - 0.5;
    }
  }
  return all > 0 ? static_cast<double>(inside) / all : 0.0;
}

}  // namespace redbee
