#include "redbee/geometry/compose_motion.hpp"

namespace redbee {

PlaneMotion compose(const PlaneMotion& cb, const PlaneMotion& ba) {
  return {cb.R_ba * ba.R_ba, cb.R_ba * ba.t_ba + cb.t_ba, ba.m_a, ba.h_a};
}

std::optional<PlaneMotion> compose(const std::optional<PlaneMotion>& cb,
                                   const std::optional<PlaneMotion>& ba) {
  if (!cb || !ba) return std::nullopt;
  return compose(*cb, *ba);
}

std::optional<Eigen::Matrix3d> composeHomographies(const std::optional<Eigen::Matrix3d>& cb,
                                                   const std::optional<Eigen::Matrix3d>& ba) {
  if (!cb || !ba) return std::nullopt;
  return normaliseHomography(*cb * *ba);
}

}  // namespace redbee
