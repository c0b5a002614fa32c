// From masks to objects with an identity.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/parameters.hpp"

namespace redbee {

struct Detection {
  int id = 0;          ///< identity, kept through missed frames and stops
  cv::Rect box;        ///< px
  double area_px = 0;  ///< of its mask
  double score = 0;    ///< mean P_FG over its mask, 0..1
  bool seen = true;    ///< false: predicted by the tracker in a frame without a component
};

/// Two thresholds (hysteresis), opening, closing, and the components that are large enough. `mask` (0 or
/// 255) holds exactly those. `probability`: P_FG * 255.
struct ForegroundComponents {
  cv::Mat1b mask;
  std::vector<Detection> components;  ///< without identity
};
ForegroundComponents findComponents(const cv::Mat1b& probability, const cv::Mat1b& unknown,
                                    const ObjectParameters& parameters);

/// Tracks objects over the ground: each has a velocity relative to it, which decays while the object is
/// missed, for a missed object has most likely stopped.
class ObjectTracker {
 public:
  explicit ObjectTracker(const ObjectParameters& parameters) : parameters_(parameters) {}

  void reset() { objects_.clear(); }
  /// The camera moves by the ground homography (previous to current, pixels).
  void carry(const Eigen::Matrix3d& ground);
  /// Assigns components to tracks. Confirmed tracks without a component follow with seen = false, until
  /// max_missed_frames or until they have left the image.
  std::vector<Detection> update(const std::vector<Detection>& components, cv::Size image);
  /// A frame in which nothing could be detected, as while a process restarts: nothing counts as missed. Up to
  /// max_missed_frames of these in a row cost no identity.
  std::vector<Detection> skip(cv::Size image);

 private:
  struct Object {
    Detection last;
    Eigen::Vector2d centre;    ///< px
    Eigen::Vector2d velocity;  ///< px a frame, against the ground
    int hits = 1;
    int missed = 0;  ///< frames in a row without a component
    int blind = 0;   ///< of these, frames that were skipped
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
