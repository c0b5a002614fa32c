// AURORA: autonomous real-time on-board video analytics (Sadeghi-Tehran, Clarke, Angelov): one homography,
// and recursive density estimation per pixel.
//
// The model is warped into each frame by the homography, as in the paper. Density of the newest value x_k
// among the k values that the pixel has had,
//   mu_k = (k-1)/k mu_(k-1) + x_k / k,   S_k = (k-1)/k S_(k-1) + |x_k|^2 / k,
//   D_k = 1 / (1 + |x_k - mu_k|^2 + S_k - |mu_k|^2),
// and foreground where D_k < mean(D) - deviation(D), both over the pixel's own past. Score: kDecisionScore at
// a tenth of a deviation, since the deviation has a lower bound (tuned), graded by (mean - D_k) / deviation.
// Their grouping of the foreground pixels is an average over a box here (tuned, EXPERIMENTS.md). Mean and
// deviation of D start when a pixel is first classified: the first densities are all 1. Images are smoothed
// first; otherwise the blur by warping would make fine texture foreground. `aurora-davis` has the best
// setting on DAVIS' clips alone: a shorter memory.
#pragma once

#include "redbee/detection/rivals/registration.hpp"
#include "redbee/detection/rivals/rival.hpp"

namespace redbee {

/// The recursion for all pixels of an image. Values are colours over `unit` grey levels.
class RecursiveDensity {
 public:
  struct Parameters {
    float unit = 512;    ///< grey levels: distance at which the density has halved; not published, tuned
    float longest = 10;  ///< frames: bound on k, which grows without bound in the paper; tuned
    float least_deviation = 0.05F;  ///< of the density: lower bound; tuned
    int learning_frames = 4;        ///< a younger pixel is not classified
  };
  RecursiveDensity(cv::Size size, const Parameters& parameters);

  void propagate(const cv::Matx33d& H);
  /// Learns an image. Returns deviations of the density below its mean, 0 where it is above or the pixel is
  /// not classified yet.
  cv::Mat1f update(const cv::Mat3b& colour);

  const cv::Mat1f& density() const { return density_; }  ///< D_k of the last update

 private:
  Parameters parameters_;
  cv::Mat3f mean_;     ///< mu
  cv::Mat3f moments_;  ///< S, mean of D, mean of D^2
  cv::Mat1f count_;    ///< k
  cv::Mat1f density_;
};

struct AuroraParameters {
  RecursiveDensity::Parameters density;
  int average_px = 15;  ///< side of the box
};

class Aurora : public Rival {
 public:
  explicit Aurora(const ObjectParameters& objects, const AuroraParameters& parameters = {})
      : Rival(objects), parameters_(parameters) {}
  DetectorNeeds needs() const override { return {true, false, 1}; }

 private:
  void reset() override;
  RivalScore scoreFrame(const FrameInput& input) override;

  AuroraParameters parameters_;
  Registrar registrar_;
  std::optional<RecursiveDensity> density_;
};

}  // namespace redbee
