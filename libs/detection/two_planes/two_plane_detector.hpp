// The paper's detector: a mixture of Gaussians for each plane; foreground matches neither (III.A).
#pragma once

#include "redbee/detection/ground_detector.hpp"
#include "redbee/detection/two_planes/two_plane_background.hpp"

namespace redbee {

class TwoPlaneDetector : public GroundDetector {
 public:
  explicit TwoPlaneDetector(const DetectionParameters& parameters)
      : GroundDetector(parameters), planes_(parameters.two_planes, parameters.learning_frames) {}
  DetectorNeeds needs() const override {
    DetectorNeeds needs;
    needs.camera_motion = true;
    return needs;
  }

 private:
  void resetBackground() override { planes_.reset(); }
  void warpBackground(const FrameInput& input) override { planes_.propagate(*input.ground, input.front); }
  ForegroundMaps learn(const FrameInput& input) override { return planes_.learn(input.grey); }

  TwoPlaneBackground planes_;
};

}  // namespace redbee
