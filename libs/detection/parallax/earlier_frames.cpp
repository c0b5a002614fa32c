#include "redbee/detection/parallax/earlier_frames.hpp"

#include <Eigen/LU>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

PlaneMotion compose(const PlaneMotion& cb, const PlaneMotion& ba) {
  return {cb.R_ba * ba.R_ba, cb.R_ba * ba.t_ba + cb.t_ba, ba.m_a, ba.h_a};
}

/// 255 above the horizon.
cv::Mat aboveHorizon(cv::Size size, const Eigen::RowVector3d& horizon) {
  cv::Mat above(size, CV_8U);
  for (int y = 0; y < size.height; ++y) {
    const double at_left = horizon.y() * y + horizon.z();
    uint8_t* row = above.ptr(y);
    for (int x = 0; x < size.width; ++x) row[x] = horizon.x() * x + at_left > 0 ? 0 : 255;
  }
  return above;
}

void growUnseen(cv::Mat& unseen, int margin_px) {
  cv::rectangle(unseen, cv::Rect({}, unseen.size()), cv::Scalar(255), 1);
  const int side = 2 * margin_px + 1;
  cv::dilate(unseen, unseen, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
}

}  // namespace

void EarlierFrames::carry(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion,
                          const std::optional<Eigen::Matrix3d>& front) {
  for (EarlierFrame& frame : frames_) {
    frame.ground = normaliseHomography(ground * frame.ground);
    if (front && (frame.front || frame.still)) {
      frame.front = normaliseHomography(*front * frame.front.value_or(Eigen::Matrix3d::Identity()));
    } else {
      frame.front.reset();
    }
    if (frame.still) {
      frame.motion = motion;
    } else if (frame.motion && motion) {
      frame.motion = compose(*motion, *frame.motion);
    } else {
      frame.motion.reset();
    }
    frame.still = false;
  }
}

void EarlierFrames::remember(int64_t utime, const cv::Mat& grey, double span_s) {
  while (!frames_.empty() && static_cast<double>(utime - frames_.front().utime) > span_s * 1e6) {
    frames_.pop_front();
  }
  EarlierFrame frame;
  frame.utime = utime;
  frame.grey = grey;
  frames_.push_back(frame);
}

const EarlierFrame* EarlierFrames::aged(int64_t now, double age_s) const {
  const int64_t wanted = now - std::llround(age_s * 1e6);
  const EarlierFrame* best = nullptr;
  for (const EarlierFrame& frame : frames_) {
    if (best == nullptr || std::abs(frame.utime - wanted) < std::abs(best->utime - wanted)) best = &frame;
  }
  return best;
}

AlignedImage alignImage(const EarlierFrame& frame, const Eigen::Matrix3d& K, int margin_px) {
  const SceneMotion scene(frame.ground, frame.motion, K);
  AlignedImage aligned{carryMap(frame.grey, scene.ground, cv::INTER_LINEAR),
                       ~overlapMask(frame.grey.size(), scene.ground)};
  const cv::Mat above = aboveHorizon(frame.grey.size(), scene.horizon);
  if (cv::countNonZero(above) > 0) {
    carryMap(frame.grey, scene.far, cv::INTER_LINEAR).copyTo(aligned.grey, above);
    cv::Mat(~overlapMask(frame.grey.size(), scene.far)).copyTo(aligned.unseen, above);
  }
  growUnseen(aligned.unseen, margin_px);
  return aligned;
}

}  // namespace redbee
