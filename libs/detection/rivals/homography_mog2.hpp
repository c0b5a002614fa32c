// One homography and OpenCV's MOG2 on the stabilised image (Zivkovic 2004): what most people build first.
//
// OpenCV's model cannot be warped. So it stays on the grid of an anchor frame, onto which images are warped
// by the homographies since; pixels outside of an image are fed with the model's own background. Once less
// than kMinOverlap of the anchor's view is left, a new model is started on the current frame, with the old
// one's background as its first image. Score: the mask (shadows are background) decides on which half of the
// scale a pixel lies, its difference to the background image where within; then averaged over a box, with
// kDecisionScore where the mean F1 of the development clips is best. History, box and decision are tuned
// (EXPERIMENTS.md), the variances' threshold is OpenCV's.
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

  void anchorHere(const cv::Mat3b& background);
  cv::Mat1b learn(const cv::Mat3b& image);

  Registrar registrar_;
  cv::Ptr<cv::BackgroundSubtractorMOG2> model_;
  cv::Matx33d anchor_ = cv::Matx33d::eye();  ///< anchor's frame to current
  int learned_ = 0;
};

}  // namespace redbee
