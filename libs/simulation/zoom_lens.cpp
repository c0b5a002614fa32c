#include "redbee/simulation/zoom_lens.hpp"

#include <cmath>
#include <random>

namespace redbee::simulation {

double ZoomLens::zoom(double t_s) const { return std::exp(logarithm.at(t_s)); }

std::vector<LensSample> simulateLens(const ZoomLens& lens, double begin_s, double end_s, ImuTime start) {
  std::mt19937 random(lens.seed);
  std::normal_distribution<double> normal;
  std::vector<LensSample> samples;
  for (int k = 0; begin_s + k / lens.rate_hz <= end_s; ++k) {
    const ImuTime time = start + fromSeconds(begin_s + k / lens.rate_hz);
    const double stated = lens.zoom(seconds(time - start) - lens.lag_s);
    samples.push_back({time, stated * (1 + lens.error_sigma * normal(random))});
  }
  return samples;
}

}  // namespace redbee::simulation
