// Merges frames, IMU samples, altitudes and a mount's rotations into one log in the order of their times.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "redbee/image_t.hpp"
#include "redbee/importers/import.hpp"
#include "redbee/inertial/mount_track.hpp"

namespace redbee {

/// What an image says of the lens.
struct StatedLens {
  ImuTime time{};
  double focal_px = 0;  ///< in an image of this width
  int width = 0;        ///< px
};

/// Frames are added one by one (they are large), the rest at once. Values that no sensor measures are left
/// out, and said (impossible_values.hpp). An IMU sample or altitude with the same
/// time as a frame is written before it.
class FlightMerger {
 public:
  FlightMerger(const std::filesystem::path& log, ImportChannels channels, std::vector<ImuSample> imu,
               std::vector<AltitudeSample> altitudes);
  /// The file of the IMU's samples and the units in which it was read: what makes them useless (checkImu())
  /// is then an InputError of close(), and a warning of the summary otherwise.
  void requirePlausibleImu(const std::filesystem::path& file, const ImuUnits& units);

  /// In order of time.
  void addMount(std::vector<MountSample> mount) { mount_ = std::move(mount); }
  /// In order of time, before the frames of later times.
  void addLens(const StatedLens& lens) { lens_.push_back(lens); }
  void addFrame(const image_t& frame);
  /// Writes the remaining samples, closes the log and fills counts, times and the IMU's warnings of the
  /// summary.
  void close(ImportSummary& summary);

 private:
  void writeUpTo(Duration time);
  void check(ImportSummary& summary) const;

  LogWriter log_;
  ImportChannels channels_;
  std::vector<ImuSample> imu_;
  std::vector<AltitudeSample> altitudes_;
  std::vector<MountSample> mount_;
  std::vector<StatedLens> lens_;
  std::optional<std::filesystem::path> imu_file_;
  ImuUnits units_;
  std::vector<std::string> left_out_;  ///< a line each
  size_t next_imu_ = 0;
  size_t next_altitude_ = 0;
  size_t next_mount_ = 0;
  size_t next_lens_ = 0;
  int64_t frames_ = 0;
  int64_t first_utime_ = 0;
  int64_t last_utime_ = 0;
};

}  // namespace redbee
