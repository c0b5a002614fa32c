// What a run over a flight leaves on disk. Every file appears under its name only when it is whole.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "redbee/detection/motion_segmenter.hpp"
#include "redbee/files/atomic_file.hpp"

namespace redbee {

/// detections.csv: MOTChallenge's columns frame (from 1), id, bb_left, bb_top, bb_width, bb_height, conf, x,
/// y, z (no world position: -1), then utime [us]. One header line.
class DetectionsCsv {
 public:
  explicit DetectionsCsv(const std::filesystem::path& path);
  /// `frame` from 0.
  void write(int64_t frame, int64_t utime, const Detection& detection);
  void close() { file_.close(); }

 private:
  AtomicFile file_;
};

/// homography.csv: utime [us], epoch, the ground's nine entries, the front plane's nine, source. Homographies
/// are row-major, ideal pixels of frame k-1 to those of frame k, h33 = 1; one that does not exist leaves its
/// fields empty.
class HomographyCsv {
 public:
  explicit HomographyCsv(const std::filesystem::path& path);
  /// `source`: "none", "inertial", "visual" or "fused".
  void write(int64_t utime, int32_t epoch, const std::optional<Eigen::Matrix3d>& ground,
             const std::optional<Eigen::Matrix3d>& front, const std::string& source);
  void close() { file_.close(); }

 private:
  AtomicFile file_;
};

void writeJson(const std::filesystem::path& path, const nlohmann::json& json);
/// Any image that OpenCV writes as PNG.
void writePng(const std::filesystem::path& path, const cv::Mat& image);

}  // namespace redbee
