#include "redbee/detection/parameters.hpp"

namespace redbee {

DetectionParameters paperDetection() {
  DetectionParameters parameters;
  parameters.method = "two_planes";
  parameters.refinement.enabled = true;
  parameters.objects.confirm_s = 0;
  parameters.objects.threshold = 0.5;  // not given in the paper
  parameters.objects.extent_threshold = parameters.objects.threshold;
  parameters.objects.weak_threshold = 0.5 * parameters.objects.threshold;
  parameters.objects.neutral = 0.73 * parameters.objects.threshold;
  return parameters;
}

}  // namespace redbee
