// Base class of the detectors with a background model that is compensated by the ground homography (paper
// III.A and III.B; libs/README.md, "Foreground and objects").
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "redbee/detection/detector.hpp"
#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/held_frames.hpp"
#include "redbee/detection/image_check.hpp"
#include "redbee/detection/objects/candidates.hpp"
#include "redbee/detection/refinement/foreground_probability.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

class GroundDetector : public Detector {
 public:
  DetectorOutput step(const FrameInput& input) final;

  /// Called with the candidates of each frame and the size of the maps that their boxes are of: for training.
  using CandidateObserver = std::function<void(CameraTime, cv::Size, const std::vector<Candidate>&)>;
  void observeCandidates(CandidateObserver observer) { observer_ = std::move(observer); }

 protected:
  explicit GroundDetector(const DetectionParameters& parameters);

 private:
  virtual void resetBackground() = 0;
  /// Warps the background model by the camera's motion, input.ground.
  virtual void warpBackground(const FrameInput& input) = 0;
  /// Classifies the image against the background, then learns it. Maps may be empty if there is no earlier
  /// frame.
  virtual ForegroundMaps learn(const FrameInput& input) = 0;

  DetectorOutput process(const FrameInput& input, bool continues, ImageContent content);
  bool isConsecutive(const FrameInput& input) const;
  void reset();
  void propagate(const FrameInput& input);
  cv::Mat1b refined(const cv::Mat1b& foreground, const FrameInput& input);
  DetectorOutput withObjects(const FrameInput& input, cv::Mat1b probability, const ForegroundMaps& maps);
  ForegroundComponents components(const FrameInput& input, const cv::Mat1b& probability,
                                  const ForegroundMaps& maps) const;

  int learning_frames_;
  RefinementParameters refinement_;
  ObjectParameters objects_;
  ImageCheck image_check_;
  ForegroundProbability probability_;
  ObjectTracker tracker_;
  cv::Size size_;
  std::optional<CameraTime> last_time_;
  std::optional<CameraTime> processed_time_;  ///< of the last frame that did not repeat an image
  HeldFrames held_;
  CandidateObserver observer_;
  int learned_ = 0;
};

}  // namespace redbee
