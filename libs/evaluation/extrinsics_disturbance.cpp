#include "redbee/evaluation/extrinsics_disturbance.hpp"

#include <cmath>
#include <cstdint>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

class SplitMix64 {
 public:
  explicit SplitMix64(std::string_view seed) {
    for (const char c : seed) state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  uint64_t next() {
    uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double sign() { return (next() >> 63) != 0 ? 1 : -1; }

 private:
  uint64_t state_ = 0xcbf29ce484222325;
};

}  // namespace

InertialExtrinsics disturbed(const InertialExtrinsics& truth, const ExtrinsicsDisturbance& amounts,
                             std::string_view seed) {
  SplitMix64 random(seed);
  const double z = 2 * random.uniform() - 1;
  const double longitude = kTurn * random.uniform();
  const double radius = std::sqrt(1 - z * z);
  const Eigen::Vector3d axis(radius * std::cos(longitude), radius * std::sin(longitude), z);
  InertialExtrinsics result = truth;
  result.R_CI = nearestRotation(expSO3(amounts.rotation_rad * axis) * truth.R_CI);
  result.timeshift_s += random.sign() * amounts.timeshift_s;
  result.start_height_m *= 1 + random.sign() * amounts.height_fraction;
  if (amounts.height_fraction > 0)
    result.start_height_sigma_m = amounts.height_fraction * truth.start_height_m;
  return result;
}

}  // namespace redbee
