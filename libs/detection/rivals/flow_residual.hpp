// Dense flow minus the flow of one homography: motion relative to the dominant plane. Not from a publication.
// Dense inverse search flow (OpenCV's, preset medium) from the current image back to the previous one, so
// that the score is on the current image's grid. The residual is averaged over a box. Score: kDecisionScore
// at 3.25 px. Box, threshold and frame distance (two) are tuned (EXPERIMENTS.md). `flow-residual-davis` has
// the best setting on DAVIS' clips alone.
#pragma once

#include <opencv2/video/tracking.hpp>

#include "redbee/detection/rivals/image_history.hpp"
#include "redbee/detection/rivals/registration.hpp"
#include "redbee/detection/rivals/rival.hpp"

namespace redbee {

struct FlowResidualParameters {
  size_t back_frames = 2;
  int average_px = 15;         ///< side of the box
  float threshold_px = 3.25F;  ///< residual at kDecisionScore
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

/// Length [px] of `flow` (current image to previous) minus the flow of `H` (previous to current). 0 where H
/// maps from outside of the previous image.
cv::Mat1f flowAgainst(const cv::Mat2f& flow, const cv::Matx33d& H);

}  // namespace redbee
