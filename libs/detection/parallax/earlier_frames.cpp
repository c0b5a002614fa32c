#include "redbee/detection/parallax/earlier_frames.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "redbee/detection/parallax/alignment_kernels.hpp"
#include "redbee/geometry/compose_motion.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

/// Current to earlier, row by row.
std::array<double, 9> inverseOf(const Eigen::Matrix3d& H) {
  cv::Matx33d back;
  cv::invert(toMatx(H), back);
  std::array<double, 9> entries{};
  std::copy_n(back.val, entries.size(), entries.begin());
  return entries;
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

void EarlierFrames::store(CameraTime time, const cv::Mat1b& grey, const Eigen::Matrix3d& K, double span_s) {
  while (!frames_.empty() && static_cast<double>((time - frames_.front().time).count()) > span_s * 1e6) {
    frames_.pop_front();
  }
  EarlierFrame frame;
  frame.time = time;
  frame.grey = grey;
  frame.K = K;
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

ImageAlignment::ImageAlignment(const EarlierFrame& frame, const Eigen::Matrix3d& K)
    : grey_(frame.grey),
      scene_(frame.ground, frame.motion, {frame.K, K}),
      ground_(inverseOf(scene_.ground)),
      far_(inverseOf(scene_.far)),
      places_(2 * static_cast<size_t>(frame.grey.cols)) {}

void ImageAlignment::alignRow(int y, int begin, int end, uint8_t* grey, uint8_t* unknown) {
  const SceneMotion::HorizonCut cut = scene_.cutAtHorizon(y, grey_.cols);
  const EarlierImage image{grey_[0], grey_.step[0], grey_.cols, grey_.rows};
  const auto align = [&](bool is_ground, int from, int to) {
    if (from < to)
      alignPixels(image, (is_ground ? ground_ : far_).data(), {y, from, to, places_.data(), grey, unknown});
  };
  align(cut.ground_first, begin, std::min(cut.at, end));
  align(!cut.ground_first, std::max(cut.at, begin), end);
}

AlignedImage alignImage(const EarlierFrame& frame, const Eigen::Matrix3d& K, int margin_px) {
  ImageAlignment alignment(frame, K);
  const cv::Size size = frame.grey.size();
  AlignedImage aligned{cv::Mat1b(size), cv::Mat1b(size)};
  for (int y = 0; y < size.height; ++y)
    alignment.alignRow(y, 0, size.width, aligned.grey[y], aligned.unknown[y]);
  growUnknown(aligned.unknown, margin_px);
  return aligned;
}

}  // namespace redbee
