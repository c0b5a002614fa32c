// OpenCV's MOG2 (Zivkovic 2004) on images stabilised by one homography: the usual baseline.
//
// OpenCV's model cannot be warped, so it stays on the grid of an anchor frame, and images are warped onto
// that; pixels outside of an image are filled with the model's background. Below an overlap of kMinOverlap
// with the anchor frame a new model is started on the current frame, with the old background as its first
// image. Score: the mask (shadows are background) selects the half of the scale, the difference to the
// background image the value within it; then averaged over a box, with kDecisionScore where the mean F1 of
// the development clips is best. History, box and decision are tuned (EXPERIMENTS.md), the variance threshold
// is OpenCV's.
#pragma once

#include <opencv2/video/background_segm.hpp>

#include "redbee/detection/rivals/registration.hpp"
#include "redbee/detection/rivals/rival.hpp"

namespace redbee {

class HomographyMog2 : public Rival {
 public:
  explicit HomographyMog2(const ObjectParameters& objects) : Rival(objects) {}
  DetectorNeeds needs() const override { return {true, false, 1}; }

 private:
  void reset() override;
  RivalScore scoreFrame(const FrameInput& input) override;

  void setAnchor(const cv::Mat3b& background);
  cv::Mat1b learn(const cv::Mat3b& image);

  Registrar registrar_;
  cv::Ptr<cv::BackgroundSubtractorMOG2> model_;
  cv::Matx33d anchor_ = cv::Matx33d::eye();  ///< anchor frame to current
  int learned_ = 0;
};

}  // namespace redbee
