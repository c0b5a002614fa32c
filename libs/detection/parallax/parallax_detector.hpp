// Our detector: dense flow relative to the camera's motion. Foreground is what moves unlike a static surface
// at any depth and differs from the background's appearance.
#pragma once

#include "redbee/detection/adjustable_quality.hpp"
#include "redbee/detection/ground_detector.hpp"
#include "redbee/detection/parallax/foreground_evidence.hpp"

namespace redbee {

class ParallaxDetector : public GroundDetector, public AdjustableQuality {
 public:
  explicit ParallaxDetector(const DetectionParameters& parameters);
  DetectorNeeds needs() const override { return needs_; }
  std::vector<std::string> rungs() const override;
  void setQuality(size_t rung) override;

 private:
  void resetBackground() override { evidence_.reset(); }
  void warpBackground(const FrameInput& input) override;
  ForegroundMaps learn(const FrameInput& input) override;

  DetectorNeeds needs_;
  ForegroundEvidence evidence_;
};

}  // namespace redbee
