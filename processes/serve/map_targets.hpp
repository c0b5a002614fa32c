// What TARGETS says, in the coordinates of the page's map.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "redbee/configuration/configuration.hpp"
#include "redbee/geolocation/local_frame.hpp"
#include "redbee/targets_t.hpp"

namespace redbee {

struct MapTarget {
  int id = 0;                  ///< as in DETECTIONS
  int8_t state = 0;            ///< target_t's constants
  Eigen::Vector2d position;    ///< m, east and north on the map
  Eigen::Vector2d velocity;    ///< m/s
  Eigen::Matrix2d covariance;  ///< m^2, of the position
  Eigen::Vector2d size;        ///< m, across and along the vertical
  double unseen_s = 0;
  std::optional<Geodetic> place;
};

/// Where the camera is and looks, by whatever mount: on the map.
struct MapCamera {
  Eigen::Vector2d position;  ///< m
  double height_m = 0;
  Eigen::Vector3d axis;                    ///< unit, east, north, up
  std::vector<Eigen::Vector2d> footprint;  ///< the image's corners; empty: one does not see the ground
};

/// Both this process and the geolocation count from the place of take-off; where there is none each counts
/// from the first position that it heard, and they may have started at different times.
class MapTargets {
 public:
  /// `frame`: the map's. `own`: on the map, where the drone was at the message's time.
  void take(const targets_t& message, const LocalFrame& frame, const std::optional<Eigen::Vector2d>& own);
  /// The map has another origin.
  void restart() { offset_.reset(); }

  /// Whether there has ever been a message.
  bool hasBegun() const { return message_.has_value(); }
  /// s that the message is older than a frame of this time [us]. Precondition: hasBegun().
  double ageAt(int64_t utime) const { return static_cast<double>(utime - message_->utime) / 1e6; }
  int64_t utime() const { return message_->utime; }
  int8_t status() const { return message_->status; }

  std::vector<MapTarget> targets() const;
  std::optional<MapCamera> camera() const;

 private:
  Eigen::Vector2d onMap(const double* east_north) const;

  std::optional<targets_t> message_;
  std::optional<Eigen::Vector2d> offset_;  ///< m, from the message's frame to the map's
  bool is_offset_global_ = false;          ///< it follows from places on WGS-84
};

/// What a status other than GOOD means, in words; empty for GOOD.
std::string wordsOfTargetStatus(int8_t status, const Channels& channels);

}  // namespace redbee
