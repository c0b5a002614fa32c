// Detectors of other authors for moving objects from a moving camera, for comparison; they can also fly.
// Implemented from the publications; each header states departures from them and the source of its
// parameters.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/detection/detector.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

/// What a rival finds in one frame.
struct RivalScore {
  DetectorStatus status = DetectorStatus::kLearning;
  /// Graded evidence of motion, of the image's size; all 0 unless kGood. kDecisionScore (graded_score.hpp) is
  /// the published (or tuned) decision threshold.
  cv::Mat1b score;
  /// The rival's own homography of the background, previous to current; the identity unless kGood.
  cv::Matx33d background = cv::Matx33d::eye();
};

/// Masks are the components of scores >= kDecisionScore, filtered and tracked by ObjectParameters; its
/// thresholds are not used.
class Rival : public Detector {
 public:
  /// Frames further apart are not consecutive.
  static constexpr Duration kMaxFrameGap = std::chrono::milliseconds(500);

  DetectorNeeds needs() const override { return {}; }
  DetectorOutput step(const FrameInput& input) final;

  /// The score, which step() uses. A gap, a repeated or earlier time, a change of size or a failed
  /// registration restarts the rival from this image.
  RivalScore score(const FrameInput& input);

 protected:
  explicit Rival(const ObjectParameters& objects);

 private:
  virtual void reset() = 0;
  /// Processes an image that is consecutive to the last one, or the first since reset(). `score` may be empty
  /// unless kGood; kNoHomography if the images cannot be registered.
  virtual RivalScore scoreFrame(const FrameInput& input) = 0;

  bool fits(const FrameInput& input) const;
  RivalScore restart(const FrameInput& input);

  ObjectParameters objects_;
  ObjectTracker tracker_;
  std::optional<CameraTime> last_time_;
  cv::Size size_;
};

}  // namespace redbee
