#include "redbee/geometry/compose_motion.hpp"

namespace redbee {

PlaneMotion compose(const PlaneMotion& cb, const PlaneMotion& ba) {
  return {cb.R_ba * ba.R_ba, cb.R_ba * ba.t_ba + cb.t_ba, ba.m_a, ba.h_a};
}

}  // namespace redbee
