#include "redbee/detection/parameters.hpp"

namespace redbee {

void decideAt(double threshold, ObjectParameters& parameters) {
  parameters.threshold = threshold;
  parameters.extent_threshold = threshold;
  parameters.weak_threshold = 0.5 * threshold;
  parameters.neutral = 0.73 * threshold;  // halfway between the two in log odds, of thresholds about 0.5
}

DetectionParameters paperDetection() {
  DetectionParameters parameters;
  parameters.method = "two_planes";
  parameters.refinement.enabled = true;
  parameters.objects.confirm_s = 0;
  decideAt(0.5, parameters.objects);  // not given in the paper
  return parameters;
}

}  // namespace redbee
