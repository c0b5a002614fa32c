// Who had stopped, kept for the next process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "redbee/geolocation/geolocator.hpp"
#include "redbee/geolocation/local_frame.hpp"

namespace redbee {

/// A file with a line for each: on WGS-84, because the metres of another process have another origin. Without
/// a fix nothing is kept, and nothing restored before there is one.
class StoppedStore {
 public:
  /// Keeps nothing.
  StoppedStore() = default;
  explicit StoppedStore(std::filesystem::path file) : file_(std::move(file)) {}

  /// Once, at the first frame with a place on WGS-84: gives the targets of the file to the geolocator.
  /// `utime`: of the frame; targets of a later time are of another flight. A file that holds something else
  /// is ignored, with a warning.
  void restore(int64_t utime, const LocalFrame& frame, Geolocator& geolocator);
  /// Writes who has stopped, as others have since the last time, and once a second of message time.
  void keep(int64_t utime, const LocalFrame& frame, const Geolocator& geolocator);

 private:
  std::filesystem::path file_;
  bool is_restored_ = false;
  int64_t written_utime_ = 0;
  std::vector<int> written_;
};

}  // namespace redbee
