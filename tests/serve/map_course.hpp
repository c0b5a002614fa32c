// How a live mosaic's map fits the ground in the course of a flight whose true plane is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "processes/conversions.hpp"
#include "processes/in_process_stack.hpp"
#include "processes/node_factory.hpp"
#include "processes/redbee/mosaic/ground_observer.hpp"
#include "processes/serve/map_fit.hpp"
#include "redbee/files/log.hpp"

namespace redbee::test {

/// Homographies of the stages that a mosaic needs: all but the detection.
inline std::vector<fused_homography_t> fusedOf(const std::filesystem::path& file,
                                               const Configuration& configuration) {
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
  int kept_ms = 0;                                ///< that it has not been true to the ground, at the end
  int longest_kept_ms = 0;                        ///< while the map was not
};

/// Of the frame at this time [us]; std::nullopt: not known.
using TruePlane = std::function<std::optional<GroundPlane>(int64_t utime)>;

/// As LiveMosaic follows it.
inline Course follow(const std::vector<fused_homography_t>& fused, const TruePlane& truth,
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
    GroundChain::Frame true_frame = *frame;
    true_frame.plane = truth(frame->utime);
    if (!misfit || !true_frame.plane) continue;
    const double error = map->misfit(true_frame, K, near).value_or(INFINITY);
    course.misfits.push_back(*misfit);
    course.errors.push_back(error);
    if (error < MapFit::kMisfit || true_utime == 0) true_utime = frame->utime;
    course.kept_ms = static_cast<int>((frame->utime - true_utime) / 1000);
    course.longest_kept_ms = std::max(course.longest_kept_ms, course.kept_ms);
    if (!fit.isContradicted(frame->utime, *misfit)) continue;
    map = map->relaid(*frame, K, near);
    course.relaid.emplace_back(error, map->misfit(true_frame, K, near).value_or(INFINITY));
    fit.laid(frame->utime);
    true_utime = frame->utime;
  }
  return course;
}

inline double quantile(std::vector<double> values, double q) {
  if (values.empty()) return NAN;
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(q * static_cast<double>(values.size() - 1))];
}

inline void print(const char* name, const Course& course) {
  std::printf(
      "%-20s lengths by the plane off by %.3f, %.3f, %.3f (median, 99 %%, worst), by the truth %.3f, %.3f, "
      "%.3f, at the end %.3f; wrong for %d ms at most\n",
      name, quantile(course.misfits, 0.5), quantile(course.misfits, 0.99), quantile(course.misfits, 1),
      quantile(course.errors, 0.5), quantile(course.errors, 0.99), quantile(course.errors, 1),
      course.errors.empty() ? NAN : course.errors.back(), course.longest_kept_ms);
  for (const auto& [before, after] : course.relaid)
    std::printf("%-20s laid anew: off by %.3f before, %.3f after\n", name, before, after);
}

}  // namespace redbee::test
