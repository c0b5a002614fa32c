// Merges frames, IMU samples and altitudes into one log in the order of their times.
#pragma once

#include <filesystem>
#include <vector>

#include "redbee/image_t.hpp"
#include "redbee/importers/import.hpp"

namespace redbee {

/// Frames are added one by one (they are large), the rest at once. An IMU sample or altitude with the same
/// time as a frame is written before it.
class FlightMerger {
 public:
  FlightMerger(const std::filesystem::path& log, ImportChannels channels, std::vector<ImuSample> imu,
               std::vector<AltitudeSample> altitudes);

  void addFrame(const image_t& frame);
  /// Writes the remaining samples, closes the log and fills counts, times and the coverage warning of the
  /// summary.
  void close(ImportSummary& summary);

 private:
  void writeUpTo(Duration time);

  LogWriter log_;
  ImportChannels channels_;
  std::vector<ImuSample> imu_;
  std::vector<AltitudeSample> altitudes_;
  size_t next_imu_ = 0;
  size_t next_altitude_ = 0;
  int64_t frames_ = 0;
  int64_t first_utime_ = 0;
  int64_t last_utime_ = 0;
};

}  // namespace redbee
