#include "redbee/importers/import.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "redbee/files/atomic_file.hpp"
#include "redbee/geometry/row_major.hpp"

namespace redbee {
namespace {

template <typename Numbers>
void emitFlow(YAML::Emitter& out, const char* key, const Numbers& numbers) {
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const double number : numbers) out << number;
  out << YAML::EndSeq;
}

void emitCamera(YAML::Emitter& out, const VehicleDescription& vehicle) {
  out << YAML::Key << "camera" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "width" << YAML::Value << vehicle.width;
  out << YAML::Key << "height" << YAML::Value << vehicle.height;
  if (vehicle.intrinsics) {
    const CameraIntrinsics& camera = *vehicle.intrinsics;
    out << YAML::Key << "fx" << YAML::Value << camera.fx << YAML::Key << "fy" << YAML::Value << camera.fy;
    out << YAML::Key << "cx" << YAML::Value << camera.cx << YAML::Key << "cy" << YAML::Value << camera.cy;
    out << YAML::Key << "model" << YAML::Value << camera.model;
    emitFlow(out, "distortion", camera.distortion);
  }
  if (vehicle.R_CI) emitFlow(out, "R_CI", rowByRow(*vehicle.R_CI));
  if (vehicle.p_IC)
    emitFlow(out, "p_IC", std::vector<double>(vehicle.p_IC->data(), vehicle.p_IC->data() + 3));
  out << YAML::EndMap;
}

void emitImu(YAML::Emitter& out, const VehicleDescription& vehicle) {
  out << YAML::Key << "imu" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "present" << YAML::Value << vehicle.has_imu;
  if (vehicle.noise) {
    out << YAML::Key << "gyro_noise_density" << YAML::Value << vehicle.noise->gyro_noise_density;
    out << YAML::Key << "accel_noise_density" << YAML::Value << vehicle.noise->accel_noise_density;
    out << YAML::Key << "gyro_random_walk" << YAML::Value << vehicle.noise->gyro_random_walk;
    out << YAML::Key << "accel_random_walk" << YAML::Value << vehicle.noise->accel_random_walk;
  }
  out << YAML::EndMap;
}

/// Without an IMU P_FG is lower: the direction of parallax is not known, and what runs out of the image is
/// muted. Thresholds found on DAVIS and UAVDT; Gull2, where nothing moves, stays clean with them.
void emitSegmentationWithoutImu(YAML::Emitter& out) {
  out << YAML::Key << "segmentation" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "threshold" << YAML::Value << 0.25;
  out << YAML::Key << "extent_threshold" << YAML::Value << 0.12;
  out << YAML::EndMap;
}

/// Whole ones; 0 for a negative duration.
std::string milliseconds(Duration d) {
  return std::to_string(std::max(Duration(0), d) / std::chrono::milliseconds(1));
}

}  // namespace

std::string vehicleYaml(const VehicleDescription& vehicle) {
  YAML::Emitter out;
  out.SetDoublePrecision(std::numeric_limits<double>::max_digits10);
  out << YAML::BeginMap << YAML::Key << "vehicle" << YAML::Value << vehicle.name;
  emitCamera(out, vehicle);
  if (vehicle.start_height) {
    out << YAML::Key << "plane" << YAML::Value << YAML::BeginMap;
    out << YAML::Key << "height_m" << YAML::Value << vehicle.start_height->height_m;
    out << YAML::Key << "height_sigma_m" << YAML::Value << vehicle.start_height->sigma_m;
    out << YAML::EndMap;
  }
  emitImu(out, vehicle);
  if (!vehicle.has_imu) emitSegmentationWithoutImu(out);
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

std::filesystem::path writeVehicleConfiguration(const VehicleDescription& vehicle,
                                                const std::filesystem::path& log) {
  std::filesystem::path path = log;
  path.replace_extension(".yaml");
  writeAtomically(path,
                  "# What the recording states about its vehicle; all else has the reference's values.\n" +
                      vehicleYaml(vehicle));
  return path;
}

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

std::optional<std::string> imuCoverageWarning(const std::vector<ImuSample>& imu, CameraTime first_frame,
                                              CameraTime last_frame) {
  if (imu.empty()) return std::nullopt;
  // A time shift or the last sample of a recording costs a few periods; more than this is a gap.
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

double meanRate(const std::vector<ImuSample>& imu) {
  if (imu.size() < 2 || imu.back().time <= imu.front().time) return 0;
  return 1e6 * static_cast<double>(imu.size() - 1) /
         static_cast<double>((imu.back().time - imu.front().time).count());
}

}  // namespace redbee
