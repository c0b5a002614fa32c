#include "redbee/importers/import.hpp"

#include <algorithm>
#include <cmath>

namespace redbee {
void assumeIntrinsics(ImportSummary& summary) {
  constexpr double kFocalFraction = 0.8;
  const VehicleDescription& vehicle = summary.vehicle;
  CameraIntrinsics camera;
  camera.width = vehicle.width;
  camera.height = vehicle.height;
  camera.fx = camera.fy = kFocalFraction * std::max(vehicle.width, vehicle.height);
  camera.cx = (vehicle.width - 1) / 2.0;
  camera.cy = (vehicle.height - 1) / 2.0;
  summary.vehicle.intrinsics = camera;
  summary.warnings.push_back("the focal length is not known: " + std::to_string(std::lround(camera.fx)) +
                             " px are assumed, 0.8 of the longer side");
}

std::optional<std::string> imuCoverageWarning(const std::vector<ImuSample>& imu, int64_t first_frame,
                                              int64_t last_frame) {
  if (imu.empty()) return std::nullopt;
  // A time shift or the last sample of a recording costs a few periods; more than this is a gap.
  constexpr int64_t kTolerance = 50'000;
  const int64_t head = imu.front().utime - first_frame;
  const int64_t tail = last_frame - imu.back().utime;
  if (imu.front().utime > last_frame || imu.back().utime < first_frame) {
    return "the IMU covers none of the frames: its times are " + std::to_string(imu.front().utime) + " to " +
           std::to_string(imu.back().utime) + " us, the frames' " + std::to_string(first_frame) + " to " +
           std::to_string(last_frame) + " us";
  }
  if (head <= kTolerance && tail <= kTolerance) return std::nullopt;
  return "the IMU does not cover all frames: it starts " + std::to_string(std::max<int64_t>(head, 0) / 1000) +
         " ms after the first and ends " + std::to_string(std::max<int64_t>(tail, 0) / 1000) +
         " ms before the last";
}

double meanRate(const std::vector<ImuSample>& imu) {
  if (imu.size() < 2 || imu.back().utime <= imu.front().utime) return 0;
  return 1e6 * static_cast<double>(imu.size() - 1) /
         static_cast<double>(imu.back().utime - imu.front().utime);
}

}  // namespace redbee
