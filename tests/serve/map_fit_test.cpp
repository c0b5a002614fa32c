// When the live mosaic's map is restarted, on rendered flights whose true plane of the ground is known: a map
// that is true to the ground stays.
#include "processes/serve/map_fit.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "tests/serve/map_course.hpp"
#include "tests/support/imported_flight.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_flight.hpp"

namespace redbee::test {
namespace {

/// Of labels/camera_pose.csv, by time [us].
std::map<int64_t, GroundPlane> truePlanes(const fs::path& file) {
  std::map<int64_t, GroundPlane> planes;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (line[0] == '#' || cells.size() < 17) continue;
    planes[std::stoll(cells[0]) / 1000] = {{std::stod(cells[14]), std::stod(cells[15]), std::stod(cells[16])},
                                           std::stod(cells[13])};
  }
  return planes;
}

class MapOfRenderedFlight : public testing::TestWithParam<const char*> {};

TEST_P(MapOfRenderedFlight, IsLaidAnewOnlyWhereItIsWrong) {
  const auto folder = sharedFlight(std::string("rendered/") + GetParam());
  if (!folder) GTEST_SKIP() << "no rendered flight";
  const ScratchFolder scratch;
  const fs::path log = scratch.path() / "flight.lcm";
  const Configuration configuration = importedAsl(*folder, log);
  const auto planes = truePlanes(*folder / "labels" / "camera_pose.csv");
  const TruePlane truth = [&planes](int64_t utime) -> std::optional<GroundPlane> {
    const auto found = planes.lower_bound(utime - 1000);
    if (found == planes.end()) return std::nullopt;
    return found->second;
  };
  const Course course = follow(fusedOf(log, configuration), truth, configuration);
  print(GetParam(), course);
  EXPECT_GT(course.misfits.size(), 100U);
  EXPECT_LT(course.longest_kept_ms, 1.5 * MapFit::kMisfit_us / 1000);
  for (const auto& [before, after] : course.relaid) {
    EXPECT_GT(before, 1.1) << "a map that is true to the ground stays";
    EXPECT_LT(after, 1.01 * before);
  }
}

INSTANTIATE_TEST_SUITE_P(Flights, MapOfRenderedFlight,
                         testing::Values("park1", "park2", "park3", "campus1", "grove1", "grove2", "island1",
                                         "street1", "rs1", "fish1"));

}  // namespace
}  // namespace redbee::test
