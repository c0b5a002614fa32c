#include "segmentation/parameters.hpp"

namespace redbee {

SegmentationParameters paperSegmentation() {
  SegmentationParameters parameters;
  parameters.method = SegmentationMethod::kTwoPlanes;
  parameters.use_refinement = true;
  parameters.confirm_frames = 1;
  parameters.threshold = 0.5;  // the paper names none
  return parameters;
}

}  // namespace redbee
