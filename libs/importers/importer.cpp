#include "redbee/importers/importer.hpp"

#include <cmath>

#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/importers/import_asl.hpp"
#include "redbee/importers/import_gopro.hpp"
#include "redbee/importers/import_video.hpp"
#include "redbee/importers/mcap/import_mcap.hpp"
#include "redbee/importers/sensor_yaml.hpp"

namespace redbee {
namespace {

std::string sizeOf(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

/// The vehicle's camera is the calibrated one at the images' size.
void setCamera(const CamchainCamera& calibrated, const std::filesystem::path& file,
               VehicleDescription& vehicle) {
  CameraIntrinsics camera = calibrated.intrinsics;
  const double scale = static_cast<double>(vehicle.width) / camera.width;
  if (std::abs(scale * camera.height - vehicle.height) > 1) {
    throw InputError(file, "resolution: is " + sizeOf(camera.width, camera.height) + ", the images are " +
                               sizeOf(vehicle.width, vehicle.height) +
                               ": another camera, or cropped; calibrate in the mode that records");
  }
  camera.width = vehicle.width;
  camera.height = vehicle.height;
  camera.fx *= scale;
  camera.fy *= scale;
  // Pixel (0, 0) is the middle of the first pixel, half a pixel from the image's corner.
  camera.cx = scale * (camera.cx + 0.5) - 0.5;
  camera.cy = scale * (camera.cy + 0.5) - 0.5;
  camera.line_delay_s /= scale;
  vehicle.intrinsics = camera;
  if (calibrated.R_CI) vehicle.R_CI = calibrated.R_CI;
  if (calibrated.p_IC) vehicle.p_IC = calibrated.p_IC;
  if (calibrated.timeshift_s) vehicle.timeshift_s = calibrated.timeshift_s;
}

void refuseToOverwrite(const ImportOptions& options) {
  std::vector<std::filesystem::path> inputs{options.source};
  inputs.insert(inputs.end(), options.further_sources.begin(), options.further_sources.end());
  requireNoneTwice(inputs);
  if (options.imu) inputs.push_back(*options.imu);
  if (options.camchain) inputs.push_back(*options.camchain);
  requireNoInput(options.log, inputs);
  const std::string extension = options.log.extension().string();
  if (extension == ".yaml" || extension == ".yml")
    throw InputError(options.log,
                     "is the name of the vehicle's configuration: give the log another, such as .lcm");
}

}  // namespace

const std::vector<Importer>& importers() {
  static const std::vector<Importer> all{aslImporter(), videoImporter(), goproImporter(), mcapImporter()};
  return all;
}

ImportSummary importRecording(const Importer& importer, const ImportOptions& options, Progress& progress) {
  refuseToOverwrite(options);
  std::optional<CamchainCamera> calibrated;
  if (options.camchain) calibrated = readCamchain(*options.camchain, options.camchain_camera);
  ImportSummary summary = importer.import(options, progress);
  if (calibrated) {
    try {
      setCamera(*calibrated, *options.camchain, summary.vehicle);
    } catch (const InputError&) {
      std::filesystem::remove(options.log);
      throw;
    }
  }
  if (!summary.vehicle.intrinsics) assumeIntrinsics(summary);
  if (summary.vehicle.has_imu && !summary.vehicle.R_CI)
    summary.warnings.emplace_back(
        "how the camera is mounted on the IMU (camera.R_CI) is not known: it looks along the IMU's x, as in "
        "the "
        "reference, or the IMU will not be used: --camchain states it, redbee calibrate finds it");
  return summary;
}

}  // namespace redbee
