// An object tracker fed with foregrounds that a test draws as rectangles.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/detection/objects/object_tracker.hpp"

namespace redbee::test {

inline const Eigen::Matrix3d kStill = Eigen::Matrix3d::Identity();

struct Region {
  cv::Rect box;              ///< px
  double probability = 0.8;  ///< P_FG
  double gain = 1;           ///< ForegroundMaps::gain
};
using Regions = std::vector<Region>;

inline ObjectParameters atOnce() {
  ObjectParameters parameters;
  parameters.opening_px = parameters.closing_px = 0;
  parameters.confirm_s = 0;
  return parameters;
}

/// Images of 640x480, 24 a second.
class TrackerFlight {
 public:
  explicit TrackerFlight(const ObjectParameters& parameters, double rate_hz = 24)
      : parameters_(parameters), tracker_(parameters), period_s_(1 / rate_hz) {}

  void propagate(double elapsed_s, const std::optional<Eigen::Matrix3d>& ground) {
    tracker_.propagate(fromSeconds(elapsed_s), ground, camera_);
  }
  /// The camera's motion in each step from now on.
  void setCamera(const CameraStep& step) { camera_ = step; }
  /// ForegroundMaps::residual of all pixels, from the next update() on.
  void setResidual(double squared) { residual_ = squared; }
  std::vector<Detection> update(const Regions& regions) {
    cv::Mat1b probability = cv::Mat1b::zeros(480, 640);
    cv::Mat1f gain(probability.size(), 1);
    const cv::Mat1f residual(probability.size(), static_cast<float>(residual_));
    for (const Region& region : regions) {
      const cv::Rect inside = region.box & cv::Rect({}, probability.size());
      if (inside.empty()) continue;
      probability(inside).setTo(255 * region.probability);
      gain(inside).setTo(region.gain);
    }
    ForegroundComponents found =
        findComponents(probability, cv::Mat1b::zeros(probability.size()), parameters_, {gain, residual});
    TrackedObjects objects = tracker_.update(found);
    mask_ = found.mask(objects.components);
    return objects.detections;
  }
  std::vector<Detection> step(const Regions& regions, const Eigen::Matrix3d& ground = kStill) {
    propagate(period_s_, ground);
    return update(regions);
  }
  std::vector<Detection> skip() {
    propagate(period_s_, std::nullopt);
    return tracker_.skip({640, 480});
  }
  /// Of the last update().
  const cv::Mat1b& mask() const { return mask_; }

 private:
  double residual_ = 1;
  std::optional<CameraStep> camera_;
  ObjectParameters parameters_;
  ObjectTracker tracker_;
  double period_s_;
  cv::Mat1b mask_;
};

}  // namespace redbee::test
