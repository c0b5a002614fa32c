// homography.csv: utime [us], epoch, nine entries of the ground's homography, nine of the front plane's,
// source. Homographies are row-major, from ideal pixels of frame k-1 to those of frame k, h33 = 1; fields of
// a missing one are empty. One header line.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "redbee/files/atomic_file.hpp"

namespace redbee {

/// One row, without its time.
struct FrameHomographies {
  int32_t epoch = 0;
  std::optional<Eigen::Matrix3d> ground;
  std::optional<Eigen::Matrix3d> front;
  std::string source;  ///< "none", "inertial", "visual" or "fused"
};

/// The file appears under its name on close(). Entries read back exactly.
class HomographyCsv {
 public:
  explicit HomographyCsv(const std::filesystem::path& file);
  void write(int64_t utime, const FrameHomographies& row);
  void close() { file_.close(); }

 private:
  AtomicFile file_;
};

/// By utime [us]. Throws InputError with file and line.
std::map<int64_t, FrameHomographies> readHomographies(const std::filesystem::path& file);

}  // namespace redbee
