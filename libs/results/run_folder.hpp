// The folder with the results of a run over a flight: names and formats for writers and readers.
//
//   probability/<utime in us>.png   8-bit, P_FG scaled to 0..255; the time has 16 digits, see nameOfFrame()
//   mask/<utime in us>.png          0 or 255
//   detections.csv                  see detections_csv.hpp
//   homography.csv                  see homography_csv.hpp
//   summary.json                    counts, frames per second, time and memory per process
//
// Every file appears under its name only when it is complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "redbee/results/detections_csv.hpp"
#include "redbee/results/homography_csv.hpp"

namespace redbee {

/// The images that a run writes for each frame.
enum class RunMap { kProbability, kMask };

/// Sixteen digits, so that every program that lists the files by name has them in order.
std::string nameOfFrame(int64_t utime);

/// Throws InputError with the file's name if something cannot be read or written.
class RunFolder {
 public:
  explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }

  /// Creates the folders for a new run and removes the maps of an earlier one.
  void prepare() const;

  /// Times of the frames that have this map, us, sorted.
  std::vector<int64_t> times(RunMap map) const;
  bool has(RunMap map, int64_t utime) const;
  cv::Mat1b read(RunMap map, int64_t utime) const;
  /// Zeros of `size` if the frame has no such map. Throws if the map has another size.
  cv::Mat1b readOrZeros(RunMap map, int64_t utime, cv::Size size) const;
  /// `png`: the encoded image.
  void write(RunMap map, int64_t utime, std::string_view png) const;

  DetectionsCsv createDetections() const { return DetectionsCsv(path_ / "detections.csv"); }
  DetectionsByTime detections() const { return readDetections(path_ / "detections.csv"); }

  HomographyCsv createHomographies() const { return HomographyCsv(path_ / "homography.csv"); }
  std::map<int64_t, FrameHomographies> homographies() const {
    return readHomographies(path_ / "homography.csv");
  }

  void writeSummary(const nlohmann::json& summary) const;
  nlohmann::json summary() const;

 private:
  std::filesystem::path folder(RunMap map) const;
  std::filesystem::path file(RunMap map, int64_t utime) const;
  std::filesystem::path existing(RunMap map, int64_t utime) const;

  std::filesystem::path path_;
};

}  // namespace redbee
