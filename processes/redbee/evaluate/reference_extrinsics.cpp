#include "processes/redbee/evaluate/reference_extrinsics.hpp"

#include <yaml-cpp/yaml.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "processes/redbee/commands/commands.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/geometry/angle.hpp"
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

void addReferenceExtrinsicsCommand(CLI::App& app) {
  auto options = std::make_shared<ReferenceExtrinsicsOptions>();
  auto* command = app.add_subcommand(
      "reference-extrinsics",
      "a configuration with a rendered clip's true extrinsics, disturbed as a calibration would");
  command->add_option("--flight", options->flight, "folder with groundtruth.yaml and labels")->required();
  command->add_option("--config", options->configuration, "the vehicle's YAML file, to be included")
      ->required();
  command->add_option("--out", options->out, "the YAML file to write")->required();
  command->add_option("--seed", options->seed, "any text; the flight folder's name unless given");
  auto degrees = std::make_shared<double>(options->disturbance.rotation_rad / kDegree);
  auto milliseconds = std::make_shared<double>(1e3 * options->disturbance.timeshift_s);
  command->add_option("--rotation-deg", *degrees, "about a random axis")->capture_default_str();
  command->add_option("--timeshift-ms", *milliseconds, "earlier or later")->capture_default_str();
  command
      ->add_option("--height-share", options->disturbance.height_fraction, "of the start height, up or down")
      ->capture_default_str();
  command->callback([options, degrees, milliseconds] {
    options->disturbance.rotation_rad = *degrees * kDegree;
    options->disturbance.timeshift_s = 1e-3 * *milliseconds;
    writeReferenceExtrinsics(*options);
  });
}

}  // namespace redbee
