// The visual stage: tracking and the ground homography for each frame (libs/README.md, "Visual homography").
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "redbee/geometry/time.hpp"
#include "redbee/visual/homography_estimation.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace redbee {

struct VisualParameters {
  TrackerParameters tracker;
  RansacParameters ransac;
  double max_frame_gap_s = 0.5;  ///< s: frames further apart are not tracked
  double min_sharpness =
      0.0;  ///< mean squared gradient [grey levels^2] below which an image is blank, black or blurred
  double min_sharpness_fraction =
      0.15;  ///< of the sharpness of the reference frame, below which an image is blurred
};

enum class VisualStatus {
  kGood,
  kFirstFrame,    ///< no reference frame: at the first frame, after a gap, a repeated or earlier time, or a
                  ///< change of size
  kNoTexture,     ///< blank, black or blurred: too few points can be tracked
  kNoPlane,       ///< points were tracked, but no plane explains enough of them
  kRepeated = 5,  ///< the reference frame's image, although the prediction has it moved
};
const char* toString(VisualStatus status);

/// The inertial prediction for a pair of frames.
struct HomographyPrediction {
  Eigen::Matrix3d H;    ///< previous to current, ideal pixels
  Matrix8d covariance;  ///< scaled
};

/// `earlier`, then `later`; their errors are taken as independent. `scaling`: that of both covariances.
HomographyPrediction compose(const HomographyPrediction& later, const HomographyPrediction& earlier,
                             const ImageScaling& scaling);

struct VisualHomography {
  CameraTime time_previous{};
  CameraTime time{};
  VisualStatus status = VisualStatus::kFirstFrame;
  PointTracks tracks;
  std::optional<HomographyEstimate> ground;  ///< present exactly when status is kGood
};

class VisualHomographyEstimator {
 public:
  /// `unknown`: see PointTracker.
  explicit VisualHomographyEstimator(const VisualParameters& parameters, const cv::Mat1b& unknown = {});

  /// In place of the constructor's, where a lens zooms; see PointTracker.
  void setUnknown(const cv::Mat1b& unknown) { tracker_.setUnknown(unknown); }

  /// Time of the reference frame, from which the next one is tracked; std::nullopt before the first.
  std::optional<CameraTime> previousTime() const { return previous_time_; }

  /// `grey`: undistorted; throws std::invalid_argument if it is empty. A blank or blurred frame
  /// (kNoTexture) or a repeated one does not become the reference: the next one is tracked from the last good
  /// frame, unless that is older than max_frame_gap_s, so `prediction` starts at previousTime(). A time that
  /// does not increase restarts from this frame. After five frames in a row without a plane the prediction is
  /// ignored for two seconds: it may be what is wrong.
  VisualHomography step(CameraTime time, const cv::Mat1b& grey,
                        const std::optional<HomographyPrediction>& prediction);

 private:
  void resetReference();
  void setReference(CameraTime time, const cv::Mat1b& half, cv::Size size, double sharpness);
  bool isRepeated(CameraTime time, const cv::Mat1b& half,
                  const std::optional<Eigen::Matrix3d>& predicted) const;
  bool lacksTexture(const Pyramid& image, double sharpness) const;
  void noteOutcome(bool predicted, bool found);
  std::optional<HomographyEstimate> estimateGround(
      const PointTracks& tracks, const std::optional<HomographyPrediction>& prediction) const;

  VisualParameters parameters_;
  PointTracker tracker_;
  std::optional<CameraTime> previous_time_;
  cv::Size size_;
  cv::Mat1b reference_half_;        ///< the reference frame at half size
  double reference_sharpness_ = 0;  ///< of the reference frame; 0 if there is none
  int failures_ = 0;                ///< frames in a row that had a prediction, and no plane
  std::optional<CameraTime> unpredicted_until_;
};

}  // namespace redbee
