// Where the vehicle and the targets of a recorded flight were.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace redbee {

struct RecordedPlace {
  int64_t utime = 0;        ///< us
  double latitude_deg = 0;  ///< WGS-84
  double longitude_deg = 0;
  double altitude_m = 0;  ///< above mean sea level, of the vehicle
};

struct RecordedTarget {
  std::vector<RecordedPlace> places;
  std::vector<double> sigmas_m;  ///< horizontal, of each place
  std::string state;             ///< the last: "moving", "stopped", "coasting"
  double speed_m_s = 0;          ///< the last
  double course_deg = 0;         ///< the last, from north to the east
  double width_m = 0;            ///< of its box
  double height_m = 0;
};

struct RecordedFlight {
  std::vector<RecordedPlace> vehicle;
  std::map<int, RecordedTarget> targets;
  int64_t frames = 0;
  int64_t damaged = 0;        ///< messages that cannot be decoded, or cannot be true
  std::string damage_report;  ///< LogReader's, of the log; empty if it is whole
};

/// From TARGETS of the log, which are computed anew from DETECTIONS, POSE and what else there is where a
/// configuration is given. Throws InputError where the log has none, or no place on WGS-84.
RecordedFlight readTargets(const std::filesystem::path& log,
                           const std::optional<std::filesystem::path>& configuration);

}  // namespace redbee
