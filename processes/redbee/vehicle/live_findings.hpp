// What the pre-flight check says of each thing that it has heard.
#pragma once

#include <filesystem>
#include <string>

#include "processes/redbee/vehicle/finding.hpp"
#include "processes/redbee/vehicle/image_quality.hpp"
#include "processes/redbee/vehicle/imu_rest.hpp"
#include "processes/redbee/vehicle/stamp_statistics.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/inertial/timeshift_monitor.hpp"
#include "redbee/process_health_t.hpp"

namespace redbee {

/// What a channel must keep, and the keys that say so.
struct StreamLimits {
  double rate_hz = 0;      ///< expected; 0: any
  std::string rate_key{};  ///< of that
  double max_gap_s = 0;    ///< 0: any
  std::string gap_key{};
  double max_jitter_s = 0;  ///< of the stamps; 0: any
  std::string source{};     ///< who publishes it, for the fix
};
StreamLimits cameraLimits(const Configuration& configuration);
StreamLimits imuLimits(const Configuration& configuration);
StreamLimits altimeterLimits(const Configuration& configuration);
StreamLimits poseLimits(const Configuration& configuration);
/// Whether something that is configured needs POSE.
bool wantsPose(const Configuration& configuration);

Finding findStream(const std::string& channel, const StampStatistics& stamps, int64_t damaged,
                   const StreamLimits& limits);
Finding findExposure(const ImageQuality& images, const Configuration& configuration);
Finding findSharpness(const ImageQuality& images, const Configuration& configuration);
Finding findTimeshift(const TimeshiftMonitor& timeshift, const Configuration& configuration);
Finding findImuNoise(const RestReport& rest, const Configuration& configuration);
Finding findHealth(const process_health_t& health);
/// `bytes_per_s`: what a recording takes.
Finding findDisk(const std::filesystem::path& folder, double bytes_per_s);

}  // namespace redbee
