// The map of a recorded flight, at any of its frames.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "processes/serve/map_view.hpp"

namespace redbee {

class FlightMap {
 public:
  explicit FlightMap(const Configuration& configuration);

  void add(const pose_t& pose) { poses_.push_back(pose); }
  void add(targets_t targets) { targets_.push_back(std::move(targets)); }
  void add(fused_homography_t fused) { motions_.push_back(std::move(fused)); }
  /// When all has been added.
  void finish();

  /// Of the frame of this time (us, camera clock). Precondition: finish().
  MapView at(int64_t utime) const;

 private:
  std::string channel_;  ///< of POSE
  int64_t timeshift_us_;
  std::vector<pose_t> poses_;  ///< these three by time
  std::vector<targets_t> targets_;
  std::vector<fused_homography_t> motions_;
  std::vector<MapBuilder>
      snapshots_;  ///< before every so many poses: an hour's path is not drawn for each frame
};

}  // namespace redbee
