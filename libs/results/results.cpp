#include "redbee/results/results.hpp"

#include <cinttypes>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "redbee/files/input_error.hpp"

namespace redbee {
namespace {

/// Nine fields with a comma before each; enough digits to read back the same numbers.
std::string entries(const std::optional<Eigen::Matrix3d>& H) {
  std::string out;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      out += ',';
      if (!H) continue;
      char text[40];
      std::snprintf(text, sizeof text, "%.17g", (*H)(row, column));
      out += text;
    }
  }
  return out;
}

}  // namespace

DetectionsCsv::DetectionsCsv(const std::filesystem::path& path) : file_(path) {
  file_.write("frame,id,bb_left,bb_top,bb_width,bb_height,conf,x,y,z,utime\n");
}

void DetectionsCsv::write(int64_t frame, int64_t utime, const Detection& detection) {
  char row[192];
  const int size = std::snprintf(row, sizeof row, "%" PRId64 ",%d,%d,%d,%d,%d,%.6g,-1,-1,-1,%" PRId64 "\n",
                                 frame + 1, detection.id, detection.box.x, detection.box.y,
                                 detection.box.width, detection.box.height, detection.score, utime);
  file_.write(row, static_cast<size_t>(size));
}

HomographyCsv::HomographyCsv(const std::filesystem::path& path) : file_(path) {
  std::string header = "utime,epoch";
  for (const char* plane : {"ground", "front"}) {
    for (int i = 0; i < 9; ++i) {
      header += std::string(",") + plane + "_h" + std::to_string(i / 3 + 1) + std::to_string(i % 3 + 1);
    }
  }
  file_.write(header + ",source\n");
}

void HomographyCsv::write(int64_t utime, int32_t epoch, const std::optional<Eigen::Matrix3d>& ground,
                          const std::optional<Eigen::Matrix3d>& front, const std::string& source) {
  file_.write(std::to_string(utime) + "," + std::to_string(epoch) + entries(ground) + entries(front) + "," +
              source + "\n");
}

void writeJson(const std::filesystem::path& path, const nlohmann::json& json) {
  writeAtomically(path, json.dump(2) + "\n");
}

void writePng(const std::filesystem::path& path, const cv::Mat& image) {
  std::vector<uint8_t> bytes;
  // Masks shrink to little at the lowest level already, and a run writes two a frame.
  if (image.empty() || !cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1})) {
    throw InputError(path, "the image cannot be encoded as PNG");
  }
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.close();
}

}  // namespace redbee
