// Ties between the mosaic's map and the earth, from the recorded poses.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "redbee/configuration/configuration.hpp"
#include "redbee/files/log.hpp"
#include "redbee/geolocation/view_estimator.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/mosaic/georeference.hpp"
#include "redbee/mosaic/mosaic.hpp"

namespace redbee {

/// Places are metres east and north on the grid of UTM, or of UPS near the poles.
struct GroundTies {
  std::vector<GroundTie> ties;
  int epsg = 0;           ///< of that grid, on WGS-84
  std::string why_empty;  ///< if there are no ties: what is missing
};

/// From POSE, GIMBAL and ALTIMETER of a log, at the times of the frames on the map. What it is made of must
/// outlive it.
class GroundTieFinder {
 public:
  GroundTieFinder(const Configuration& configuration, const Camera& camera, const GroundFrames& frames,
                  const MosaicGrid& grid);

  /// Any event of the log, in its order.
  void note(const LogEvent& event);
  /// After the last event; once.
  GroundTies result();

 private:
  struct Zone {
    int number = 0;
    bool is_north = true;
  };

  void add(const MappedFrame& frame);
  ImuTime timeOf(const MappedFrame& frame) const;
  std::optional<Eigen::Vector2d> onGrid(const Eigen::Vector2d& position);
  std::string whyEmpty() const;

  const Configuration& configuration_;
  CameraIntrinsics ideal_;
  const std::vector<MappedFrame>& frames_;
  MosaicGrid grid_;
  ViewEstimator views_;
  size_t next_ = 0;  ///< of the frames
  GroundTies found_;
  std::optional<Zone> zone_;
  ViewFault fault_ = ViewFault::kNoPose;
};

}  // namespace redbee
