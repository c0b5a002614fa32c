// Frames that repeat an image: what was found in it stays, and the camera's motion is kept for the next new
// one.
#pragma once

#include <optional>

#include "redbee/detection/detector.hpp"

namespace redbee {

class HeldFrames {
 public:
  /// `output`: of a new image.
  void begin(const DetectorOutput& output);
  void reset() { *this = {}; }
  /// True if a repetition at this time is still one, kMaxRepetition.
  bool covers(CameraTime time) const;
  /// Precondition: covers(). The output of the image that is repeated. `repeated`: has a homography.
  DetectorOutput hold(const FrameInput& repeated);
  /// `next` with the camera's motion since the image that was repeated.
  FrameInput sinceImage(FrameInput next) const;

 private:
  struct Motion {
    Eigen::Matrix3d ground;
    std::optional<Eigen::Matrix3d> front;
    std::optional<PlaneMotion> motion;
    std::optional<Eigen::Matrix3d> K_previous;
  };
  std::optional<DetectorOutput> output_;
  std::optional<Motion> since_;
};

}  // namespace redbee
