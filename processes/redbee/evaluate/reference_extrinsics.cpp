#include "processes/redbee/evaluate/reference_extrinsics.hpp"

#include <yaml-cpp/yaml.h>

#include <limits>
#include <memory>
#include <vector>

#include "redbee/configuration/configuration.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/importers/sensor_yaml.hpp"

namespace redbee {
namespace {

double firstHeight(const std::filesystem::path& file) {
  constexpr size_t kHeightColumn = 13;  // timestamp, frame, p_WC, q_WC, q_WS, height
  CsvReader csv(file);
  if (!csv.next(0) || csv.fields().size() <= kHeightColumn)
    throw InputError(file, "holds no pose of a frame");
  return csv.number(kHeightColumn);
}

void emitList(YAML::Emitter& out, const char* key, const std::vector<double>& numbers) {
  out << YAML::Key << key << YAML::Value << YAML::Flow << numbers;
}

std::string yamlOf(const InertialExtrinsics& extrinsics, const std::filesystem::path& include) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = extrinsics.R_CI;
  YAML::Emitter out;
  out.SetDoublePrecision(std::numeric_limits<double>::max_digits10);
  out << YAML::BeginMap << YAML::Key << "include" << YAML::Value << include.string();
  out << YAML::Key << "camera" << YAML::Value << YAML::BeginMap;
  emitList(out, "R_CI", std::vector<double>(R.data(), R.data() + 9));
  emitList(out, "p_IC", std::vector<double>(extrinsics.p_IC.data(), extrinsics.p_IC.data() + 3));
  out << YAML::Key << "timeshift_s" << YAML::Value << extrinsics.timeshift_s << YAML::EndMap;
  out << YAML::Key << "plane" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "height_m" << YAML::Value << extrinsics.start_height_m;
  out << YAML::Key << "height_sigma_m" << YAML::Value << extrinsics.start_height_sigma_m;
  out << YAML::EndMap << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

}  // namespace

InertialExtrinsics readTrueExtrinsics(const std::filesystem::path& flight) {
  const TrueExtrinsics truth = readTrueCameraExtrinsics(flight / "groundtruth.yaml");
  InertialExtrinsics extrinsics;
  extrinsics.R_CI = truth.pose.R_BS.transpose();  // the rendered drones' body is their IMU
  extrinsics.p_IC = truth.pose.p_BS;
  extrinsics.timeshift_s = truth.timeshift_s;
  extrinsics.start_height_m = firstHeight(flight / "labels" / "camera_pose.csv");
  return extrinsics;
}

void writeReferenceExtrinsics(const ReferenceExtrinsicsOptions& options) {
  loadConfiguration(options.configuration);  // what is wrong with it is better told now
  const auto flight = std::filesystem::weakly_canonical(options.flight);
  const std::string seed = options.seed.empty() ? flight.filename().string() : options.seed;
  const InertialExtrinsics extrinsics = disturbed(readTrueExtrinsics(flight), options.disturbance, seed);
  const auto include =
      std::filesystem::relative(options.configuration, std::filesystem::absolute(options.out).parent_path());
  writeAtomically(options.out, "# True extrinsics, disturbed by what a calibration leaves.\n" +
                                   yamlOf(extrinsics, include));
}

}  // namespace redbee
