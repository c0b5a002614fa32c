#include "redbee/fusion/fused_homography.hpp"

namespace redbee {

const char* toString(FusionSource source) {
  switch (source) {
    case FusionSource::kNone:
      return "none";
    case FusionSource::kInertial:
      return "inertial";
    case FusionSource::kVisual:
      return "visual";
    case FusionSource::kFused:
      return "fused";
  }
  return "unknown";
}

}  // namespace redbee
