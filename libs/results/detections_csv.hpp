// detections.csv: the columns of MOTChallenge, frame (from 1), id, bb_left, bb_top, bb_width, bb_height [px],
// conf (0..1), x, y, z (no world position: -1), then utime [us] and seen (0: predicted by the tracker). One
// header line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

#include "redbee/detection/objects/object_tracker.hpp"
#include "redbee/files/atomic_file.hpp"

namespace redbee {

/// Appears under its name on close().
class DetectionsCsv {
 public:
  explicit DetectionsCsv(const std::filesystem::path& file);
  /// `frame` from 0.
  void write(int64_t frame, int64_t utime, const Detection& detection);
  void close() { file_.close(); }

 private:
  AtomicFile file_;
};

using DetectionsByTime = std::multimap<int64_t, Detection>;  ///< by utime [us]

/// Area is not in the file and keeps its default; without the column `seen` all are seen. Throws InputError
/// with file and line.
DetectionsByTime readDetections(const std::filesystem::path& file);

}  // namespace redbee
