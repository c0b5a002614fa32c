// Checks in flight whether the calibration is consistent with the innovations between the inertial and the
// visual homography.
//
// With a correct calibration the innovations scatter about zero and their test ratios are small. A wrong
// R_CI, time shift or height makes the test ratios persistently large. Single frames are not conclusive; a
// running mean over some seconds is.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

namespace redbee {

class CalibrationMonitor {
 public:
  struct Parameters {
    double memory_frames = 72;  ///< frames over which the running means fade
    int min_frames = 48;        ///< before a status other than "unknown"
    double misfit_ratio = 1.0;  ///< mean test ratio (1: the gate) above which the calibration does not fit
    double misfit_px = 1.0;     ///< and mean distance of the two homographies
  };

  CalibrationMonitor() : CalibrationMonitor(Parameters()) {}
  explicit CalibrationMonitor(const Parameters& parameters) : parameters_(parameters) {}

  /// One frame: squared Mahalanobis distance of the innovation over its gate, and mean transfer error between
  /// the predicted and the measured homography [px]. Values that are not finite are ignored.
  void note(double test_ratio, double distance_px) {
    if (!std::isfinite(test_ratio) || !std::isfinite(distance_px)) return;
    ++frames_;
    const double rate = 1.0 / std::fmin(static_cast<double>(frames_), parameters_.memory_frames);
    // One gross outlier must not outweigh a second of flight.
    ratio_ += rate * (std::fmin(test_ratio, 10.0) - ratio_);
    distance_px_ += rate * (std::fmin(distance_px, 100.0) - distance_px_);
  }

  /// Whether the IMU is left out because vision contradicts it: then there are no innovations.
  void setDisagreement(bool disagrees) { disagrees_ = disagrees; }

  bool decided() const { return frames_ >= parameters_.min_frames; }
  bool fits() const { return ratio_ <= parameters_.misfit_ratio || distance_px_ <= parameters_.misfit_px; }
  double meanDistance_px() const { return distance_px_; }
  double meanRatio() const { return ratio_; }

  /// "unknown", "fits", "does not fit: IMU and camera disagree", or "does not fit: predicted homography off
  /// by 3 px". The pixels are rounded, so that the text seldom changes.
  std::string status() const {
    if (disagrees_) return "does not fit: IMU and camera disagree";
    if (!decided()) return "unknown";
    if (fits()) return "fits";
    char text[80];
    std::snprintf(text, sizeof text, "does not fit: predicted homography off by %.0f px",
                  std::fmax(distance_px_, 1.0));
    return text;
  }

 private:
  Parameters parameters_;
  int frames_ = 0;
  bool disagrees_ = false;
  double ratio_ = 0;
  double distance_px_ = 0;
};

}  // namespace redbee
