// When the live mosaic's map is laid anew, on rendered flights whose true plane of the ground is known: a map
// that is true to the ground stays.
#include "processes/serve/map_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "processes/conversions.hpp"
#include "processes/in_process_stack.hpp"
#include "processes/node_factory.hpp"
#include "processes/redbee/mosaic/ground_observer.hpp"
#include "redbee/files/log.hpp"
#include "redbee/node/message_check.hpp"
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

/// Homographies of the stages that a mosaic needs: all but the detection.
std::vector<fused_homography_t> fusedOf(const fs::path& folder, Configuration& configuration) {
  const ScratchFolder scratch;
  const fs::path file = scratch.path() / "flight.lcm";
  configuration = importedAsl(folder, file);
  const auto bus = makeLcmBus("memq://");
  std::vector<fused_homography_t> fused;
  const auto subscription = bus->subscribe<fused_homography_t>(
      configuration.channels.fused_homography, 64, [&](const fused_homography_t& m) { fused.push_back(m); });
  Nodes nodes;
  for (const auto* process : {&kImuIntegration, &kVisualHomography, &kHomographyFusion})
    nodes.push_back(makeNode(*process, *bus, configuration));
  InProcessStack stack(*bus, configuration.channels.health, std::move(nodes));
  LogReader log(file);
  while (const auto event = log.next()) {
    bus->publish(event->channel, event->data);
    stack.settle();
  }
  stack.finish();
  return fused;
}

struct Course {
  std::vector<double> misfits;                    ///< by the estimated plane
  std::vector<double> errors;                     ///< of the map, by the true one
  std::vector<std::pair<double, double>> relaid;  ///< errors before and after
  int longest_kept_ms = 0;                        ///< while the map was not
};

/// As LiveMosaic follows it.
Course follow(const std::vector<fused_homography_t>& fused, const std::map<int64_t, GroundPlane>& truth,
              const Configuration& configuration) {
  const Camera camera(configuration.camera);
  const Eigen::Matrix3d& K = camera.K();
  const Eigen::Vector2d near(0.5 * camera.ideal().width, 0.75 * camera.ideal().height);
  GroundChain chain;
  Exposures exposures;
  std::optional<MapReference> map;
  MapFit fit;
  Course course;
  int64_t true_utime = 0;
  for (const fused_homography_t& m : fused) {
    note(m, exposures, chain);
    const GroundChain::Frame* frame = chain.frame(m.utime_previous);
    if (frame == nullptr || !frame->plane) continue;
    if (!map) {
      map.emplace(*frame, K);
      fit.laid(frame->utime);
    }
    const auto misfit = map->misfit(*frame, K, near);
    const auto plane = truth.lower_bound(frame->utime - 1000);
    if (!misfit || plane == truth.end()) continue;
    GroundChain::Frame true_frame = *frame;
    true_frame.plane = plane->second;
    const double error = map->misfit(true_frame, K, near).value_or(INFINITY);
    course.misfits.push_back(*misfit);
    course.errors.push_back(error);
    if (error < MapFit::kMisfit || true_utime == 0) true_utime = frame->utime;
    course.longest_kept_ms =
        std::max(course.longest_kept_ms, static_cast<int>((frame->utime - true_utime) / 1000));
    if (!fit.isContradicted(frame->utime, *misfit)) continue;
    map = map->relaid(*frame, K, near);
    course.relaid.emplace_back(error, map->misfit(true_frame, K, near).value_or(INFINITY));
    fit.laid(frame->utime);
    true_utime = frame->utime;
  }
  return course;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return NAN;
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(q * static_cast<double>(values.size() - 1))];
}

class MapOfRenderedFlight : public testing::TestWithParam<const char*> {};

TEST_P(MapOfRenderedFlight, IsLaidAnewOnlyWhereItIsWrong) {
  const auto folder = sharedFlight(std::string("rendered/") + GetParam());
  if (!folder) GTEST_SKIP() << "no rendered flight";
  Configuration configuration;
  const auto fused = fusedOf(*folder, configuration);
  const Course course = follow(fused, truePlanes(*folder / "labels" / "camera_pose.csv"), configuration);
  std::printf(
      "%-8s lengths by the plane off by %.3f, %.3f, %.3f (median, 99 %%, worst), by the truth %.3f, %.3f, "
      "%.3f; "
      "wrong for %d ms at most\n",
      GetParam(), quantile(course.misfits, 0.5), quantile(course.misfits, 0.99), quantile(course.misfits, 1),
      quantile(course.errors, 0.5), quantile(course.errors, 0.99), quantile(course.errors, 1),
      course.longest_kept_ms);
  EXPECT_GT(course.misfits.size(), 100U);
  EXPECT_LT(course.longest_kept_ms, 1.5 * MapFit::kMisfit_us / 1000);
  for (const auto& [before, after] : course.relaid) {
    std::printf("%-8s laid anew: off by %.3f before, %.3f after\n", GetParam(), before, after);
    EXPECT_GT(before, 1.1) << "a map that is true to the ground stays";
    EXPECT_LT(after, 1.01 * before);
  }
}

INSTANTIATE_TEST_SUITE_P(Flights, MapOfRenderedFlight,
                         testing::Values("park1", "park2", "park3", "campus1", "grove1", "grove2", "island1",
                                         "street1", "rs1", "fish1"));

}  // namespace
}  // namespace redbee::test
