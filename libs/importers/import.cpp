#include "redbee/importers/import.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "redbee/importers/impossible_values.hpp"

namespace redbee {
namespace {

/// Whole ones; 0 for a negative duration.
std::string milliseconds(Duration d) {
  return std::to_string(std::max(Duration(0), d) / std::chrono::milliseconds(1));
}

}  // namespace

void assumeIntrinsics(ImportSummary& summary) {
  constexpr double kFocalFraction = 0.8;
  const VehicleDescription& vehicle = summary.vehicle;
  CameraIntrinsics camera;
  camera.width = vehicle.width;
  camera.height = vehicle.height;
  camera.fx = kFocalFraction * std::max(vehicle.width, vehicle.height);
  camera.fy = camera.fx * vehicle.pixel_aspect;
  camera.cx = (vehicle.width - 1) / 2.0;
  camera.cy = (vehicle.height - 1) / 2.0;
  summary.vehicle.intrinsics = camera;
  summary.warnings.push_back("the focal length is not known: " + std::to_string(std::lround(camera.fx)) +
                             " px are assumed, 0.8 of the longer side");
}

std::optional<std::string> imuCoverageWarning(const std::vector<ImuSample>& imu, CameraTime first_frame,
                                              CameraTime last_frame) {
  if (imu.empty()) return std::nullopt;
  // A time shift or the end of a recording may leave a few periods uncovered; more than this is a gap.
  constexpr Duration kTolerance = std::chrono::milliseconds(50);
  const ImuTime first = toImu(first_frame, Duration(0));
  const ImuTime last = toImu(last_frame, Duration(0));
  const Duration head = imu.front().time - first;
  const Duration tail = last - imu.back().time;
  if (imu.front().time > last || imu.back().time < first) {
    return "the IMU covers none of the frames: its times are " + std::to_string(toUtime(imu.front().time)) +
           " to " + std::to_string(toUtime(imu.back().time)) + " us, the frames' " +
           std::to_string(toUtime(first_frame)) + " to " + std::to_string(toUtime(last_frame)) + " us";
  }
  if (head <= kTolerance && tail <= kTolerance) return std::nullopt;
  return "the IMU does not cover all frames: it starts " + milliseconds(head) +
         " ms after the first and ends " + milliseconds(tail) + " ms before the last";
}

std::optional<AltitudeSample> startHeight(const std::vector<AltitudeSample>& altitudes, ImuTime first_frame) {
  constexpr Duration kWindow = std::chrono::milliseconds(200);
  std::optional<AltitudeSample> nearest;
  for (const AltitudeSample& sample : altitudes) {
    const Duration distance = std::chrono::abs(sample.time - first_frame);
    if (distance > kWindow || sample.height_m <= 0 || !isPossible(sample)) continue;
    if (!nearest || distance < std::chrono::abs(nearest->time - first_frame)) nearest = sample;
  }
  return nearest;
}

double meanRate(const std::vector<ImuSample>& imu) {
  if (imu.size() < 2 || imu.back().time <= imu.front().time) return 0;
  return 1e6 * static_cast<double>(imu.size() - 1) /
         static_cast<double>((imu.back().time - imu.front().time).count());
}

}  // namespace redbee
