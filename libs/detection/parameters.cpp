#include "redbee/detection/parameters.hpp"

namespace redbee {

SegmentationParameters paperSegmentation() {
  SegmentationParameters parameters;
  parameters.method = SegmentationMethod::kTwoPlanes;
  parameters.use_refinement = true;
  parameters.sample_grid_px = 16;  // and its tracks are as far apart
  parameters.confirm_frames = 1;
  parameters.threshold = 0.5;  // the paper names none
  parameters.extent_threshold = parameters.threshold;
  return parameters;
}

}  // namespace redbee
