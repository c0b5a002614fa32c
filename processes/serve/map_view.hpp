// What the page's map shows: own position, path and footprint on a plain metric grid.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "redbee/configuration/configuration.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/pose_t.hpp"

namespace redbee {

/// East and north in metres: from the origin of the autopilot's estimator, or where it has none from the
/// first position.
struct MapView {
  struct Own {
    Eigen::Vector2d position;
    double heading_rad = 0;          ///< of the body's forward axis, from north over east
    std::optional<double> height_m;  ///< above the ground, or above the place of take-off
  };
  std::optional<Own> own;
  std::vector<Eigen::Vector2d> path;       ///< oldest first
  std::vector<Eigen::Vector2d> footprint;  ///< the image's corners on the ground; empty: unknown
  std::string note;                        ///< what is missing, in words; empty: nothing
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
  /// As of a frame at this time (us, camera clock).
  MapView view(int64_t utime) const;

 private:
  std::optional<Eigen::Vector2d> positionOf(const pose_t& pose);
  std::optional<double> heightAt(int64_t utime) const;

  Camera camera_;
  Eigen::Matrix3d R_IC_;
  int64_t timeshift_us_;
  std::optional<pose_t> pose_;
  std::optional<Eigen::Vector2d> position_;
  std::optional<Eigen::Vector2d> origin_deg_;  ///< latitude and longitude, where positions are global only
  bool is_local_ = false;
  std::deque<Eigen::Vector2d> path_;
  int64_t height_utime_ = 0;
  double height_m_ = 0;
};

}  // namespace redbee
