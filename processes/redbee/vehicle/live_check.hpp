// The pre-flight check: what the running stack's channels say within some seconds, against the configuration.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "processes/redbee/vehicle/finding.hpp"
#include "processes/redbee/vehicle/image_quality.hpp"
#include "processes/redbee/vehicle/stamp_statistics.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/inertial/timeshift_monitor.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/process_health_t.hpp"

namespace redbee {

/// Listens while it exists, as far as `bus` is handled. Implausible messages are counted as damaged.
class LiveCheck {
 public:
  LiveCheck(Bus& bus, const Configuration& configuration);

  /// Of any channel that it listens to.
  bool hasHeard() const { return heard_ > 0; }
  /// One line each, in the order of a pre-flight check.
  std::vector<Finding> findings() const;
  /// Of what a recorder would write, as far as it is heard here.
  int64_t bytes() const;

 private:
  void onImu(const ins_t& message);
  void onFused(const fused_homography_t& message);
  void compareRotations(const inertial_homography_t& inertial, const fused_homography_t& fused);

  Configuration configuration_;
  Camera camera_;
  std::map<std::string, StampStatistics> stamps_;  ///< by channel
  std::map<std::string, int64_t> damaged_;         ///< by channel
  int64_t heard_ = 0;
  ImageQuality images_;
  std::vector<ImuSample> imu_;
  TimeshiftMonitor timeshift_;
  std::map<int64_t, inertial_homography_t> inertial_;  ///< recent ones, by frame
  std::map<std::string, process_health_t> health_;     ///< the last of each process
  std::vector<Subscription> subscriptions_;
};

}  // namespace redbee
