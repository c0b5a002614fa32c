#include "processes/redbee/evaluate/reference_extrinsics.hpp"

#include <yaml-cpp/yaml.h>

#include "redbee/configuration/configuration.hpp"
#include "redbee/configuration/configuration_files.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
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

std::string yamlOf(const InertialExtrinsics& extrinsics, const std::filesystem::path& include) {
  YAML::Emitter first_line;  // quotes the path where it has to be
  first_line << YAML::BeginMap << YAML::Key << "include" << YAML::Value << include.string() << YAML::EndMap;
  Configuration configuration;
  configuration.inertial.extrinsics = extrinsics;
  return std::string(first_line.c_str()) + "\n" +
         emitYaml(configuration, {"camera.R_CI", "camera.p_IC", "camera.timeshift_s", "plane.height_m",
                                  "plane.height_sigma_m"});
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
  requireNoInput(options.out, options.configuration, {});  // throws where the configuration is wrong, too
  const auto flight = std::filesystem::weakly_canonical(options.flight);
  const std::string seed = options.seed.empty() ? flight.filename().string() : options.seed;
  const InertialExtrinsics extrinsics = disturbed(readTrueExtrinsics(flight), options.disturbance, seed);
  const auto include =
      std::filesystem::relative(options.configuration, std::filesystem::absolute(options.out).parent_path());
  writeAtomically(options.out, "# True extrinsics plus the error that a calibration leaves.\n" +
                                   yamlOf(extrinsics, include));
}

}  // namespace redbee
