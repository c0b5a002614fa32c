// What the page's map shows: own position, path, footprint and targets on a plain metric grid.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "processes/serve/map_targets.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/geolocation/local_frame.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/pose_t.hpp"

namespace redbee {

/// East and north in metres, from the origin that local_frame.hpp says.
struct MapView {
  struct Own {
    Eigen::Vector2d position;
    double heading_rad = 0;                         ///< of the body's forward axis, from north over east
    std::optional<double> height_m;                 ///< above the ground, or above the place of take-off
    std::optional<Eigen::Vector2d> axis_on_ground;  ///< where the camera's optical axis meets the ground
  };
  std::optional<Own> own;
  std::vector<Eigen::Vector2d> path;       ///< oldest first
  std::vector<Eigen::Vector2d> footprint;  ///< the image's corners on the ground; empty: unknown
  std::vector<MapTarget> targets;
  std::optional<Geodetic> origin;        ///< the place of (0, 0), where it is known
  std::optional<int64_t> targets_utime;  ///< us, of the frame that they are about
  std::string note;                      ///< what is missing, in words; empty: nothing
};

/// Where the corners of the camera's image meet flat ground, relative to the camera: east and north [m]. Rays
/// less than 5 degrees below the horizon are cut off there. Empty where none of them meets the ground.
/// R_GC turns camera coordinates into east, north, up.
std::vector<Eigen::Vector2d> footprintOf(const Camera& camera, const Eigen::Matrix3d& R_GC, double height_m);

class MapBuilder {
 public:
  explicit MapBuilder(const Configuration& configuration);

  void onPose(const pose_t& pose);
  void onFused(const fused_homography_t& fused);
  void onTargets(const targets_t& targets);
  bool hasTargets() const { return targets_.hasBegun(); }
  /// As of a frame at this time (us, camera clock).
  MapView view(int64_t utime) const;

 private:
  std::optional<Eigen::Vector2d> ownAt(int64_t utime) const;
  std::optional<double> heightAt(int64_t utime) const;
  void addOwn(int64_t utime, MapView& view) const;
  void addFootprint(const std::optional<MapCamera>& camera, MapView& view) const;
  void addTargets(int64_t utime, MapView& view) const;
  bool isFresh(int64_t utime) const;

  Channels channels_;
  Camera camera_;
  Eigen::Matrix3d R_IC_;
  int64_t timeshift_us_;
  bool has_gimbal_;
  bool has_autopilot_;
  bool zooms_;  ///< the lens, which TARGETS heeds
  LocalFrame frame_;
  MapTargets targets_;
  std::optional<pose_t> pose_;
  std::optional<Eigen::Vector2d> position_;
  std::deque<Eigen::Vector2d> path_;
  int64_t height_utime_ = 0;
  double height_m_ = 0;
};

}  // namespace redbee
