// Images of a textured plane and a patch that slides over it, with exact camera motion.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "redbee/detection/rivals/rival.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::test {

struct PatchFrame {
  FrameInput input;
  cv::Mat truth;  ///< CV_8U, 255 on the patch
};

struct SlidingPatch {
  cv::Size size{480, 360};
  int frames = 16;
  cv::Point2d patch_step{3, 1.5};  ///< px a frame of the first frame's grid
  bool has_patch = true;
  bool camera_moves = true;
  bool has_motion = true;  ///< false: as without an IMU
};

inline cv::Mat colourTexture(cv::Size size, uint64_t seed, const cv::Scalar& tint) {
  cv::RNG random(seed);
  cv::Mat coarse(size / 12, CV_32FC3), fine(size / 5, CV_32FC3), map;
  random.fill(coarse, cv::RNG::UNIFORM, -50, 50);
  random.fill(fine, cv::RNG::UNIFORM, -15, 15);
  cv::resize(coarse, coarse, size, 0, 0, cv::INTER_CUBIC);
  cv::resize(fine, fine, size, 0, 0, cv::INTER_CUBIC);
  cv::Mat(coarse + fine + tint).convertTo(map, CV_8UC3);
  return map;
}

/// The plane is 5 m away and faces the first camera.
inline PlaneMotion planeStep(bool camera_moves) {
  const double scale = camera_moves ? 1 : 0;
  PlaneMotion step;
  step.R_ba = expSO3(scale * Eigen::Vector3d(0.001, -0.002, 0.003));
  step.t_ba = scale * Eigen::Vector3d(0.02, -0.012, -0.01);
  step.m_a = Eigen::Vector3d(0, 0, 1);
  step.h_a = 5;
  return step;
}

inline std::vector<PatchFrame> slidingPatch(const SlidingPatch& options) {
  const cv::Size canvas = options.size * 2;
  const cv::Matx33d to_first(1, 0, -options.size.width / 2.0, 0, 1, -options.size.height / 2.0, 0, 0, 1);
  const cv::Mat ground = colourTexture(canvas, 1, cv::Scalar(70, 90, 80));
  const cv::Mat coat = colourTexture(canvas, 2, cv::Scalar(190, 160, 170));
  cv::Mat outline = cv::Mat::zeros(canvas, CV_8U);
  const cv::Rect patch(canvas.width / 2 - 90, canvas.height / 2 - 60, 100, 80);
  if (options.has_patch) outline(patch).setTo(255);
  Eigen::Matrix3d K;
  K << 400, 0, options.size.width / 2.0, 0, 400, options.size.height / 2.0, 0, 0, 1;
  PlaneMotion step = planeStep(options.camera_moves);
  Eigen::Matrix3d since_first = Eigen::Matrix3d::Identity();
  cv::RNG random(3);
  std::vector<PatchFrame> frames;
  for (int k = 0; k < options.frames; ++k) {
    PatchFrame frame;
    frame.input.time = CameraTime(std::chrono::seconds(1) + k * std::chrono::milliseconds(40));
    frame.input.K = K;
    if (k > 0) {
      since_first = planeHomography(K, step) * since_first;
      if (options.has_motion) frame.input.motion = step;
      // The plane, seen from the next camera.
      step.h_a += step.m_a.dot(step.R_ba.transpose() * step.t_ba);
      step.m_a = step.R_ba * step.m_a;
    }
    cv::Matx33d H;
    cv::eigen2cv(since_first, H);
    const cv::Matx33d slid(1, 0, k * options.patch_step.x, 0, 1, k * options.patch_step.y, 0, 0, 1);
    cv::Mat moved;
    cv::warpPerspective(ground, frame.input.colour, H * to_first, options.size);
    cv::warpPerspective(coat, moved, H * to_first * slid, options.size);
    cv::warpPerspective(outline, frame.truth, H * to_first * slid, options.size, cv::INTER_NEAREST);
    moved.copyTo(frame.input.colour, frame.truth);
    cv::Mat noise(options.size, CV_16SC3);
    random.fill(noise, cv::RNG::NORMAL, 0, 1.5);
    cv::add(frame.input.colour, noise, frame.input.colour, cv::noArray(), CV_8UC3);
    cv::cvtColor(frame.input.colour, frame.input.grey, cv::COLOR_BGR2GRAY);
    frames.push_back(frame);
  }
  return frames;
}

/// With the defaults, made once.
inline const std::vector<PatchFrame>& slidingPatch() {
  static const std::vector<PatchFrame> frames = slidingPatch(SlidingPatch());
  return frames;
}
/// Homography of the plane from frame k-1 to frame k.
inline Eigen::Matrix3d trueStep(size_t k) {
  return planeHomography(slidingPatch()[k].input.K, *slidingPatch()[k].input.motion);
}

/// Area under the ROC curve: the probability that a pixel of the patch scores above one of the rest, ties
/// counting one half.
class RankStatistic {
 public:
  void add(const cv::Mat& score, const cv::Mat& truth) {
    for (int y = 0; y < score.rows; ++y) {
      for (int x = 0; x < score.cols; ++x)
        ++counts_[truth.at<uint8_t>(y, x) != 0 ? 1 : 0][score.at<uint8_t>(y, x)];
    }
  }
  double auc() const {
    double below = 0, good = 0, patch = 0;
    for (size_t s = 0; s < 256; ++s) {
      good += counts_[1][s] * (below + 0.5 * counts_[0][s]);
      below += counts_[0][s];
      patch += counts_[1][s];
    }
    return good / (below * patch);
  }
  /// Fraction of the rest, or of the patch, that scores at least this.
  double fractionAbove(bool patch, size_t score) const {
    double above = 0, all = 0;
    for (size_t s = 0; s < 256; ++s) {
      all += counts_[patch ? 1 : 0][s];
      if (s >= score) above += counts_[patch ? 1 : 0][s];
    }
    return all > 0 ? above / all : 0;
  }

 private:
  double counts_[2][256] = {};
};

}  // namespace redbee::test
