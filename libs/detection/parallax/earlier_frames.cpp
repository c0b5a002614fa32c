#include "redbee/detection/parallax/earlier_frames.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/geometry/compose_motion.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

/// 255 above the horizon.
cv::Mat1b aboveHorizon(cv::Size size, const SceneMotion& scene) {
  cv::Mat1b above(size);
  for (int y = 0; y < size.height; ++y) {
    const SceneMotion::HorizonCut cut = scene.cutAtHorizon(y, size.width);
    std::fill_n(above[y], cut.at, uint8_t(cut.ground_first ? 0 : 255));
    std::fill(above[y] + cut.at, above[y] + size.width, uint8_t(cut.ground_first ? 255 : 0));
  }
  return above;
}

void growUnknown(cv::Mat1b& unknown, int margin_px) {
  cv::rectangle(unknown, cv::Rect({}, unknown.size()), cv::Scalar(255), 1);
  const int side = 2 * margin_px + 1;
  cv::dilate(unknown, unknown, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
}

}  // namespace

void EarlierFrames::propagate(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion,
                              const std::optional<Eigen::Matrix3d>& front) {
  for (EarlierFrame& frame : frames_) {
    frame.ground = normaliseHomography(ground * frame.ground);
    const std::optional<Eigen::Matrix3d> none = Eigen::Matrix3d::Identity();
    frame.front = composeHomographies(front, frame.still ? none : frame.front);
    frame.motion = frame.still ? motion : compose(motion, frame.motion);
    frame.still = false;
  }
}

void EarlierFrames::store(CameraTime time, const cv::Mat1b& grey, double span_s) {
  while (!frames_.empty() && static_cast<double>((time - frames_.front().time).count()) > span_s * 1e6) {
    frames_.pop_front();
  }
  EarlierFrame frame;
  frame.time = time;
  frame.grey = grey;
  frames_.push_back(frame);
}

const EarlierFrame* EarlierFrames::aged(CameraTime now, double age_s) const {
  const CameraTime wanted = now - fromSeconds(age_s);
  const EarlierFrame* best = nullptr;
  for (const EarlierFrame& frame : frames_) {
    if (best == nullptr || std::chrono::abs(frame.time - wanted) < std::chrono::abs(best->time - wanted))
      best = &frame;
  }
  return best;
}

AlignedImage alignImage(const EarlierFrame& frame, const Eigen::Matrix3d& K, int margin_px) {
  const SceneMotion scene(frame.ground, frame.motion, K);
  AlignedImage aligned{warpToCurrent(frame.grey, scene.ground, cv::INTER_LINEAR),
                       ~overlapMask(frame.grey.size(), scene.ground)};
  const cv::Mat1b above = aboveHorizon(frame.grey.size(), scene);
  if (cv::countNonZero(above) > 0) {
    warpToCurrent(frame.grey, scene.far, cv::INTER_LINEAR).copyTo(aligned.grey, above);
    cv::Mat1b(~overlapMask(frame.grey.size(), scene.far)).copyTo(aligned.unknown, above);
  }
  growUnknown(aligned.unknown, margin_px);
  return aligned;
}

}  // namespace redbee
