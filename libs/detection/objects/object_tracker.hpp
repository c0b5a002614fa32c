// Segmentation of the foreground into components, and tracking of objects over time.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/parameters.hpp"

namespace redbee {

struct Detection {
  int id = 0;          ///< identity, kept while the object is missed or stops
  cv::Rect box;        ///< px
  double area_px = 0;  ///< area of its mask, px^2
  double score = 0;    ///< mean P_FG in its mask, 0..1
  bool seen = true;    ///< false: no component in this frame, predicted by the tracker
};

/// Components of the foreground by hysteresis thresholding, opening, closing and a minimum area. `mask` (0 or
/// 255) contains exactly these components. `probability`: P_FG * 255.
struct ForegroundComponents {
  cv::Mat1b mask;
  std::vector<Detection> components;  ///< without identity
};
ForegroundComponents findComponents(const cv::Mat1b& probability, const cv::Mat1b& unknown,
                                    const ObjectParameters& parameters);

/// Tracks objects over the ground. Each has a velocity relative to the ground, which decays while the object
/// is missed, since it has probably stopped.
class ObjectTracker {
 public:
  explicit ObjectTracker(const ObjectParameters& parameters) : parameters_(parameters) {}

  void reset() { objects_.clear(); }
  /// Predicts all tracks by the camera's motion: ground homography, previous to current pixels.
  void propagate(const Eigen::Matrix3d& ground);
  /// Assigns components to tracks. Confirmed tracks without a component are returned with seen = false, until
  /// max_missed_frames or until they leave the image.
  std::vector<Detection> update(const std::vector<Detection>& components, cv::Size image);
  /// For a frame without detection, e.g. while a process restarts: no track counts as missed. Identities
  /// survive up to max_missed_frames such frames in a row.
  std::vector<Detection> skip(cv::Size image);

 private:
  struct Object {
    Detection last;
    Eigen::Vector2d centre;    ///< px
    Eigen::Vector2d velocity;  ///< px per frame, relative to the ground
    int hits = 1;
    int missed = 0;   ///< consecutive frames without a component
    int skipped = 0;  ///< of these, skipped frames
    bool confirmed = false;
  };

  void associate(const std::vector<Detection>& components, std::vector<int>& component_of_object) const;
  void observe(Object& object, const Detection& component) const;
  static void miss(Object& object);
  void deleteLostTracks(const cv::Rect& view);
  std::vector<Detection> confirmedTracks(const cv::Rect& view);

  ObjectParameters parameters_;
  std::vector<Object> objects_;
  int next_id_ = 1;
};

}  // namespace redbee
