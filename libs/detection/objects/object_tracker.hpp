// Tracking of objects over time, before and after they are reported. libs/README.md, "Foreground and
// objects".
#pragma once

#include <Eigen/Core>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/detection/objects/box_filter.hpp"
#include "redbee/detection/objects/components.hpp"
#include "redbee/detection/objects/static_path.hpp"
#include "redbee/detection/parameters.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

struct Detection {
  int id = 0;          ///< identity, kept while the object is missed or stops
  cv::Rect box;        ///< px
  double area_px = 0;  ///< area of its mask, px^2
  double score = 0;    ///< mean P_FG in its mask, 0..1
  bool seen = true;    ///< false: not in this frame's mask, predicted by the tracker
};

struct TrackedObjects {
  std::vector<Detection> detections;  ///< of the confirmed tracks inside the image
  std::vector<size_t> components;     ///< of this frame, those that the seen detections consist of
};

/// Tracks over the ground, each with a Kalman filter. Components are assigned in two steps (ByteTrack, Zhang
/// et al. 2022): the strong ones, which exceed `threshold`, then the weak ones to the tracks left over. Every
/// component begins a track; it is reported once the log odds of its components, over time, confirm it.
class ObjectTracker {
 public:
  explicit ObjectTracker(const ObjectParameters& parameters, const ParallaxParameters& parallax = {});

  void reset() { tracks_.clear(); }
  /// To the next frame, before update() or skip(). `elapsed`: since the previous frame; negative counts as
  /// none. `ground`: homography, previous to current [px]; `camera`: over the same step, for the test of the
  /// paths against static surfaces. std::nullopt if unknown.
  void propagate(Duration elapsed, const std::optional<Eigen::Matrix3d>& ground,
                 const std::optional<CameraStep>& camera = std::nullopt);
  /// Assigns components to tracks; one that covers several objects is split in `found`. Confirmed tracks
  /// without a component are returned with seen = false for max_missed_s, or until they leave the image.
  TrackedObjects update(ForegroundComponents& found);
  /// For a frame without detection, e.g. while a process restarts: no track counts as missed. Identities
  /// survive max_missed_s of such frames in a row.
  std::vector<Detection> skip(cv::Size image);

 private:
  struct Track {
    BoxFilter filter;
    Component last;                                    ///< what it was last found as
    int id = 0;                                        ///< 0: not confirmed
    double age_s = 0;                                  ///< since its first component
    double missed_s = 0;                               ///< since its last component
    double skipped_s = 0;                              ///< of this, in skipped frames
    double evidence_s = 0;                             ///< integral of its log odds over time
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< px: where on the ground it was first found
    double farthest = 0;           ///< distance from there, in roots of the box's area, the greatest so far
    std::deque<PathPoint> path{};  ///< where it was found
    std::vector<size_t> components{};  ///< of this frame
  };
  enum class Strength { kStrong, kWeak, kAny };

  void splitMerged(ForegroundComponents& found) const;
  std::vector<const Track*> coveredApart(const cv::Rect2d& box) const;
  void assignAll(const ForegroundComponents& found);
  void assignTo(bool confirmed, Strength strength, const ForegroundComponents& found);
  void absorbParts(const std::vector<Component>& components);
  std::vector<size_t> unassigned(Strength strength, const std::vector<Component>& components) const;
  void begin(size_t component, const ForegroundComponents& found);
  void observe(Track& track, const ForegroundComponents& found) const;
  void notePlace(Track& track, const BoxMeasurement& measured) const;
  double motionLogOdds(const Track& track) const;
  void miss(Track& track) const;
  void deleteLostTracks(cv::Size image);
  TrackedObjects report(cv::Size image);

  ObjectParameters parameters_;
  double neutral_log_odds_;  ///< of a component that says nothing
  double direction_error_;   ///< rad
  CameraPath camera_;
  std::vector<Track> tracks_;
  double elapsed_s_ = 0;
  int next_id_ = 1;
};

}  // namespace redbee
