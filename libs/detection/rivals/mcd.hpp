// Dual-mode single Gaussian model with motion compensation: Yi, Yun, Kim, Chang, Choi, "Detection of Moving
// Objects with Non-Stationary Cameras in 5.8ms", CVPR Workshops 2013.
//
// Every block of 4x4 px has two Gaussians of grey (mean, variance, age); the older explains the background,
// the other is the candidate to replace it. Models are warped into each frame by one homography; the order of
// classification and learning is that of the authors' code (99.6 to 99.9 % of the decisions are the same).
// Constants are theirs except for the maximum age (30), the minimum variance (25) and the average over a box,
// which are tuned (EXPERIMENTS.md). Score: |grey - mean| / (2 sigma), the published decision, graded,
// averaged over the box, with kDecisionScore where the mean F1 of the development clips is best.
#pragma once

#include <array>

#include "redbee/detection/rivals/registration.hpp"
#include "redbee/detection/rivals/rival.hpp"

namespace redbee {

/// A block's Gaussian of grey levels.
struct GreyGaussian {
  float mean = 0;        ///< grey levels
  float variance = 400;  ///< grey levels^2
  float age = 0;         ///< frames
};

/// Model 0 is the background's, model 1 the candidate's.
using DualModel = std::array<GreyGaussian, 2>;

/// The Gaussian interpolated between four blocks: weighted mean, variance including the spread of the means,
/// age reduced if the variance is large (equations 8 to 11). `weights` sum to at most 1; the rest lies
/// outside of the image. Age 0 if all of it does.
GreyGaussian blendGaussians(const std::array<GreyGaussian, 4>& models, const std::array<float, 4>& weights);

/// The Gaussian that the pixels of a block are compared with.
struct BlockBackground {
  float mean;       ///< grey levels, of model 0 after its update
  float variance;   ///< grey levels^2, of model 0 before its update
  bool classifies;  ///< false: model 0 is too young
};

/// Updates a block's models; the candidate becomes the background when it is as old. `mean`: of the block;
/// `least`, `greatest`: its extreme pixels.
BlockBackground updateDualModel(DualModel& model, float mean, float least, float greatest);

class Mcd : public Rival {
 public:
  explicit Mcd(const ObjectParameters& objects) : Rival(objects) {}

  static constexpr int kBlockPx = 4;

 private:
  void reset() override;
  RivalScore scoreFrame(const FrameInput& input) override;

  void propagate(const cv::Matx33d& H);
  GreyGaussian modelAt(size_t which, double column, double row) const;
  cv::Mat1b updateAndScore(const cv::Mat1b& grey);

  Registrar registrar_;
  DualModel& model(int row, int column) { return models_[static_cast<size_t>(row * blocks_.width + column)]; }
  const DualModel& model(int row, int column) const {
    return models_[static_cast<size_t>(row * blocks_.width + column)];
  }

  cv::Size blocks_;                ///< complete blocks of the image; the remaining border is not classified
  std::vector<DualModel> models_;  ///< row by row
};

}  // namespace redbee
