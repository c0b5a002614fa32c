// The bundled flight, replayed: homographies, areas and detections of every frame against the file in the
// repository, so that any change of the output shows in the diff of a commit. REDBEE_UPDATE_GOLDEN=1 rewrites
// the file; REDBEE_GOLDEN_FRAMES=N compares the first N frames alone, as on an emulated processor.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <sstream>

#include "processes/redbee/detect/detect.hpp"
#include "redbee/files/csv.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/results/run_folder.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

struct Row {
  int64_t utime = 0;
  int area = 0;
  int detections = 0;
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
};
using Rows = std::map<int64_t, Row>;

fs::path source() { return REDBEE_SOURCE_DIR; }
fs::path goldenFile() { return source() / "tests" / "golden" / "park1.csv"; }

Rows rowsOf(const RunFolder& run) {
  Rows rows;
  for (const int64_t utime : run.times(RunMap::kMask)) {
    Row& row = rows[utime];
    row.utime = utime;
    row.area = cv::countNonZero(run.read(RunMap::kMask, utime));
  }
  for (const auto& [utime, homographies] : run.homographies()) {
    if (homographies.ground) rows[utime].H = *homographies.ground;
  }
  for (const auto& [utime, detection] : run.detections()) ++rows[utime].detections;
  return rows;
}

void write(const fs::path& file, const Rows& rows) {
  std::ofstream out(file);
  out << "# utime [us], mask area [px], detections, ground homography (9): the bundled flight through the "
         "default configuration\n";
  for (const auto& [utime, row] : rows) {
    out << utime << ',' << row.area << ',' << row.detections;
    for (int i = 0; i < 9; ++i) {
      std::ostringstream entry;
      entry.precision(i == 2 || i == 5 ? 5 : 7);
      entry << row.H(i / 3, i % 3);
      out << ',' << entry.str();
    }
    out << '\n';
  }
}

Rows read(const fs::path& file) {
  Rows rows;
  CsvReader csv(file);
  while (csv.next(12)) {
    Row row;
    row.utime = csv.integer(0);
    row.area = static_cast<int>(csv.integer(1));
    row.detections = static_cast<int>(csv.integer(2));
    for (int i = 0; i < 9; ++i) row.H(i / 3, i % 3) = csv.number(static_cast<size_t>(3 + i));
    rows[row.utime] = row;
  }
  return rows;
}

TEST(Golden, TheBundledFlightIsUnchanged) {
  const fs::path results = fs::temp_directory_path() / ("redbee-golden-" + std::to_string(::getpid()));
  DetectOptions options;
  options.log = source() / "logs" / "park1.lcm";
  options.configuration = source() / "config" / "park1.yaml";
  options.out = results;
  options.quiet = true;
  if (const char* frames = std::getenv("REDBEE_GOLDEN_FRAMES")) options.frames = std::atoll(frames);
  runDetect(options);
  const Rows rows = rowsOf(RunFolder(results));
  fs::remove_all(results);
  if (std::getenv("REDBEE_UPDATE_GOLDEN") != nullptr) write(goldenFile(), rows);

  Rows golden = read(goldenFile());
  while (options.frames > 0 && static_cast<int64_t>(golden.size()) > options.frames)
    golden.erase(std::prev(golden.end()));
  ASSERT_EQ(rows.size(), golden.size());
  // Rounding differs between processors, so single pixels at a threshold may differ.
  double most_px = 0;
  int other_counts = 0;
  int64_t area = 0;
  int64_t area_changes = 0;
  for (const auto& [utime, expected] : golden) {
    ASSERT_EQ(rows.count(utime), 1u) << utime;
    const Row& row = rows.at(utime);
    const double error_px = meanTransferError(row.H, expected.H, 640, 480);
    EXPECT_LT(error_px, 0.02) << utime;
    most_px = std::max(most_px, error_px);
    other_counts += row.detections != expected.detections ? 1 : 0;
    area += expected.area;
    area_changes += std::abs(row.area - expected.area);
  }
  std::cout << golden.size() << " frames: homographies within " << most_px << " px, mask areas differ by "
            << area_changes << " of " << area << " px, " << other_counts << " other counts of detections\n";
  EXPECT_LE(other_counts, static_cast<int>(golden.size()) / 50);
  EXPECT_LE(area_changes, area / 50)
      << "run with REDBEE_UPDATE_GOLDEN=1 if the change is meant, and commit the file";
}

}  // namespace
}  // namespace redbee
