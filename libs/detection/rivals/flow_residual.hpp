// Dense flow minus the flow of one homography: whatever moves against the dominant plane.
//
// Not from a publication. Dense inverse search flow (OpenCV's, preset medium) forward from the previous
// image's grid is not used: it is computed from the current image back to the previous one, so that the score
// lies on the current image. What remains is averaged over a box. Score: kDecisionScore at 3.25 px. Box,
// threshold and how many frames back the flow reaches (two) are tuned (EXPERIMENTS.md). `flow-residual-davis`
// has what was best on DAVIS' clips alone.
#pragma once

#include <opencv2/video/tracking.hpp>

#include "redbee/detection/rivals/image_history.hpp"
#include "redbee/detection/rivals/registration.hpp"
#include "redbee/detection/rivals/rival.hpp"

namespace redbee {

struct FlowResidualParameters {
  size_t back_frames = 2;
  int average_px = 15;         ///< side of the box
  float threshold_px = 3.25F;  ///< where kDecisionScore lies
};

class FlowResidual : public Rival {
 public:
  explicit FlowResidual(const ObjectParameters& objects, const FlowResidualParameters& parameters = {});

 private:
  void reset() override;
  RivalScore scoreFrame(const FrameInput& input) override;

  FlowResidualParameters parameters_;
  Registrar registrar_;
  cv::Ptr<cv::DISOpticalFlow> flow_;
  ImageHistory history_;
};

/// Length [px] of what remains of `flow` (current image to previous) once each pixel's own motion
/// by `H` (previous to current) is taken out. 0 where H takes it from outside of the previous image.
cv::Mat1f flowAgainst(const cv::Mat2f& flow, const cv::Matx33d& H);

}  // namespace redbee
