// redbee export mcap: a flight, and what was detected in it, for Foxglove and ROS 2's tools.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace redbee {

struct McapExport {
  std::filesystem::path log;                           ///< LCM log
  std::filesystem::path out;                           ///< F.mcap
  std::optional<std::filesystem::path> results;        ///< of detect or collect: boxes
  std::optional<std::filesystem::path> configuration;  ///< of the vehicle: its camera as camera_info
};

struct McapExported {
  std::map<std::string, int64_t> messages;  ///< written, by topic
  std::map<std::string, int64_t> left_out;  ///< messages without a counterpart, by channel
  int64_t damaged = 0;                      ///< of those that have one
  std::vector<std::string> warnings;
};

/// Topics are the channels' names in lower case: /camera/image and /camera/camera_info, /imu, /altimeter,
/// /detections (ImageAnnotations), /foreground/mask and /foreground/probability, /process_health/PROCESS,
/// /log. Times are those of the messages. Throws InputError, and then there is no file; also where nothing is
/// exported, or no box is of a frame of the log.
McapExported exportMcap(const McapExport& options);

}  // namespace redbee
