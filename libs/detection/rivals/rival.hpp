// Other detectors of moving objects from a moving camera, behind one interface, to be measured against ours.
//
// Written from their descriptions; each header states where it departs from them and where its parameters
// come from. All see ideal (undistorted) images in order of time.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "redbee/geometry/homography.hpp"

namespace redbee {

struct RivalInput {
  int64_t utime = 0;  ///< us
  cv::Mat grey;       ///< CV_8U
  cv::Mat colour;     ///< CV_8UC3, BGR, of the same size; may be empty unless wantsColour()
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();  ///< camera matrix
  std::optional<PlaneMotion> motion;                ///< of the camera since the previous frame, from an IMU
};

enum class RivalStatus {
  kGood,
  kLearning,  ///< no model to compare with yet
  kLost,      ///< the images could not be registered, or are not consecutive: it restarts
  kBadImage,  ///< empty or of the wrong type; nothing was learned from it
};

struct RivalOutput {
  RivalStatus status = RivalStatus::kLearning;
  /// CV_8U, the image's size: graded evidence of motion, all 0 unless kGood. 128 is the published (or tuned)
  /// decision threshold.
  cv::Mat score;
  /// The rival's own homography of the background, previous to current; the identity unless kGood.
  cv::Matx33d background = cv::Matx33d::eye();
};

class Rival {
 public:
  /// Frames further apart than this are not consecutive [us].
  static constexpr int64_t kMaxFrameGapUs = 500'000;

  virtual ~Rival() = default;
  virtual bool wantsColour() const { return false; }
  virtual bool wantsMotion() const { return false; }

  /// A gap, a repeated or earlier time, a change of size and a lost registration each restart it from this
  /// image; see the status.
  RivalOutput step(const RivalInput& input);

 private:
  virtual void reset() = 0;
  /// Processes an image that is consecutive to the last one, or the first since reset(). `score` may be left
  /// empty unless kGood.
  virtual RivalOutput judge(const RivalInput& input) = 0;

  bool fits(const RivalInput& input) const;
  RivalOutput beginAnew(const RivalInput& input);

  std::optional<int64_t> last_utime_;
  cv::Size size_;
};

/// Null for a name that is none of rivalNames().
std::unique_ptr<Rival> makeRival(const std::string& name);
std::vector<std::string> rivalNames();

}  // namespace redbee
