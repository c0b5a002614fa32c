// redbee log info: what a log holds, as rosbag info says it of a bag.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace redbee {

struct ChannelSurvey {
  std::string type;  ///< of the first message: its name, or its hash; with size and pixel format of images
  int64_t messages = 0;
  int64_t damaged = 0;      ///< messages of a known type that cannot be decoded
  int64_t other_types = 0;  ///< messages of another type than the first
  int64_t bytes = 0;        ///< of the messages
  int64_t first_utime = 0;  ///< us, of the log's events
  int64_t last_utime = 0;
  int64_t longest_gap_us = 0;

  double rate() const;  ///< Hz, mean; 0 for fewer than two messages
};

struct LogSurvey {
  std::map<std::string, ChannelSurvey> channels;
  int64_t bytes = 0;
  int64_t damaged = 0;  ///< places that were skipped
  bool truncated = false;
  std::string damage_report;  ///< one line, of the first damage; empty: the log is whole

  int64_t messages() const;
};

/// Throws InputError if the file is no log.
LogSurvey surveyLog(const std::filesystem::path& log);

/// One line "damage: none" or "damage: ...", then the table of channels.
std::string asText(const LogSurvey& survey, const std::filesystem::path& log);

}  // namespace redbee
