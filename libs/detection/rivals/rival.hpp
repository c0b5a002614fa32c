// Other detectors of moving objects from a moving camera, to be measured against ours, or flown.
//
// Written from their descriptions; each header states where it departs from them and where its parameters
// come from.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/detection/detector.hpp"

namespace redbee {

/// What a rival finds in one frame.
struct RivalScore {
  DetectorStatus status = DetectorStatus::kLearning;
  /// Graded evidence of motion, of the image's size, all 0 unless kGood. kDecisionScore (graded_score.hpp) is
  /// the published (or tuned) decision threshold.
  cv::Mat1b score;
  /// The rival's own homography of the background, previous to current; the identity unless kGood.
  cv::Matx33d background = cv::Matx33d::eye();
};

/// Masks are the components of scores from kDecisionScore on, cleaned and tracked as the configuration has
/// it; objects.threshold and objects.extent_threshold do not apply.
class Rival : public Detector {
 public:
  /// Frames further apart than this are not consecutive [us].
  static constexpr int64_t kMaxFrameGapUs = 500'000;

  DetectorNeeds needs() const override { return {}; }
  DetectorOutput step(const FrameInput& input) final;

  /// The score alone; step() calls it. A gap, a repeated or earlier time, a change of size and a lost
  /// registration each restart the rival from this image.
  RivalScore score(const FrameInput& input);

 protected:
  explicit Rival(const ObjectParameters& objects);

 private:
  virtual void reset() = 0;
  /// Processes an image that is consecutive to the last one, or the first since reset(). `score` may be left
  /// empty unless kGood; kNoHomography where the images cannot be registered.
  virtual RivalScore scoreFrame(const FrameInput& input) = 0;

  bool fits(const FrameInput& input) const;
  RivalScore restart(const FrameInput& input);

  ObjectParameters objects_;
  ObjectTracker tracker_;
  std::optional<int64_t> last_utime_;
  cv::Size size_;
};

}  // namespace redbee
