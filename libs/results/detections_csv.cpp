#include "redbee/results/detections_csv.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "redbee/files/csv.hpp"

namespace redbee {

DetectionsCsv::DetectionsCsv(const std::filesystem::path& file) : file_(file) {
  file_.write("frame,id,bb_left,bb_top,bb_width,bb_height,conf,x,y,z,utime,seen\n");
}

void DetectionsCsv::write(int64_t frame, int64_t utime, const Detection& detection) {
  const cv::Rect& box = detection.box;
  file_.write(fmt::format("{},{},{},{},{},{},{:.6g},-1,-1,-1,{},{}\n", frame + 1, detection.id, box.x, box.y,
                          box.width, box.height, detection.score, utime, detection.seen ? 1 : 0));
}

DetectionsByTime readDetections(const std::filesystem::path& file) {
  constexpr size_t kFewest = 11;
  constexpr size_t kSeen = 11;
  DetectionsByTime detections;
  CsvReader csv(file);
  csv.next(0);  // the names of the columns
  const size_t columns = std::max(kFewest, csv.fields().size());
  while (csv.next(columns)) {
    Detection detection;
    detection.id = static_cast<int>(csv.integer(1));
    detection.box = {static_cast<int>(csv.number(2)), static_cast<int>(csv.number(3)),
                     static_cast<int>(csv.number(4)), static_cast<int>(csv.number(5))};
    detection.score = csv.number(6);
    if (columns > kSeen) detection.seen = csv.integer(kSeen) != 0;
    detections.emplace(csv.integer(10), detection);
  }
  return detections;
}

}  // namespace redbee
