#include "processes/redbee/calibrate/calibration_files.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "processes/redbee/pages/number.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/camera_model.hpp"
#include "redbee/geometry/row_major.hpp"

namespace redbee {
namespace {

using calibration::CalibrationInput;
using calibration::CalibrationResult;
using calibration::ParameterReport;
using calibration::Verdict;

/// Reads back exactly.
std::string exact(double value) { return significant(value, 17); }

std::string rounded(double value) { return significant(value, 4); }

template <typename Numbers>
std::string list(const Numbers& numbers) {
  std::string text = "[";
  for (const double number : numbers) text += (text.size() > 1 ? ", " : "") + exact(number);
  return text + "]";
}

std::string list(const Eigen::Vector3d& v) { return list(std::vector<double>(v.data(), v.data() + 3)); }

/// Rows of a homogeneous transform as YAML's list of lists.
std::string transformRows(const Eigen::Matrix3d& R, const Eigen::Vector3d& t, const std::string& indent) {
  std::string text;
  for (int row = 0; row < 3; ++row) {
    text += indent + "- " + list(std::vector<double>{R(row, 0), R(row, 1), R(row, 2), t(row)}) + "\n";
  }
  return text + indent + "- [0.0, 0.0, 0.0, 1.0]\n";
}

std::string origin(const CalibrationSubject& subject) {
  return "# redbee calibrate, vehicle " + subject.vehicle + ", from " + subject.source + "\n";
}

bool isKept(const CalibrationResult& result, const char* name) {
  const Verdict verdict = result.parameter(name).verdict;
  return verdict == Verdict::kFound || verdict == Verdict::kWeak;
}

std::string verdictComment(const CalibrationResult& result, const char* name) {
  const ParameterReport& report = result.parameter(name);
  return std::string("# ") + name + ": " + toString(report.verdict) + ", " + report.explanation + "\n";
}

double imuRate(const CalibrationInput& input) {
  if (input.imu.size() < 2) return 0;
  const auto [first, last] = std::minmax_element(
      input.imu.begin(), input.imu.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return 1e6 * static_cast<double>(input.imu.size() - 1) /
         static_cast<double>((last->time - first->time).count());
}

/// Keys of the configuration that the recording shows.
class FoundKeys {
 public:
  template <typename Value>
  void set(const char* key, Value& member, const Value& value) {
    member = value;
    keys_.emplace_back(key);
  }
  std::string yaml() const { return emitYaml(configuration, keys_); }

  Configuration configuration;

 private:
  std::vector<std::string> keys_;
};

void setExtrinsics(const CalibrationResult& result, FoundKeys& found) {
  InertialExtrinsics& extrinsics = found.configuration.inertial.extrinsics;
  const InertialExtrinsics& kept = result.values.kept;
  if (isKept(result, "camera.R_CI")) found.set("camera.R_CI", extrinsics.R_CI, kept.R_CI);
  if (isKept(result, "camera.p_IC")) found.set("camera.p_IC", extrinsics.p_IC, kept.p_IC);
  if (isKept(result, "camera.timeshift_s"))
    found.set("camera.timeshift_s", extrinsics.timeshift_s, kept.timeshift_s);
  if (isKept(result, "plane.height_m")) {
    found.set("plane.height_m", extrinsics.start_height_m, kept.start_height_m);
    found.set("plane.height_sigma_m", extrinsics.start_height_sigma_m,
              std::max(kept.start_height_sigma_m, 1e-3));
  }
}

void setSensorErrors(const CalibrationResult& result, FoundKeys& found) {
  if (isKept(result, "camera.line_delay_s"))
    found.set("camera.line_delay_s", found.configuration.camera.line_delay_s, result.values.line_delay_s);
  if (isKept(result, "imu.gyro_correction")) {
    found.set("imu.gyro_correction", found.configuration.inertial.gyro_correction,
              result.values.gyro_correction);
  }
}

/// The turn-on bias that the online filter expects, where the estimated one is far beyond it.
void setBiasSigmas(const CalibrationInput& input, const CalibrationResult& result, FoundKeys& found) {
  InertialParameters& inertial = found.configuration.inertial;
  const double gyro = result.values.gyro_bias.cwiseAbs().maxCoeff();
  const double accel = result.values.accel_bias.cwiseAbs().maxCoeff();
  if (isKept(result, "gyro_bias") && gyro > 2 * input.gyro_bias_sigma)
    found.set("imu.gyro_bias_sigma", inertial.gyro_bias_sigma, gyro);
  if (isKept(result, "accel_bias") && accel > 2 * input.accel_bias_sigma)
    found.set("imu.accel_bias_sigma", inertial.accel_bias_sigma, accel);
}

}  // namespace

std::string kalibrCamchain(const CalibrationInput& input, const CalibrationResult& result,
                           const CalibrationSubject& subject) {
  const CameraIntrinsics& camera = input.camera;
  std::vector<double> kalibrs = camera.distortion;
  kalibrs.resize(findCameraModel(camera.model)->fewest);
  const InertialExtrinsics& kept = result.values.kept;
  const Eigen::Matrix3d R_IC = kept.R_CI.transpose();
  const double delay_s = result.values.line_delay_s;
  std::ostringstream text;
  text << origin(subject) << verdictComment(result, "camera.R_CI") << verdictComment(result, "camera.p_IC")
       << verdictComment(result, "camera.timeshift_s") << "cam0:\n"
       << "  cam_overlaps: []\n  camera_model: pinhole\n"
       << "  distortion_coeffs: " << list(kalibrs) << "\n"
       << "  distortion_model: " << camera.model << "\n";
  if (kalibrs.size() < camera.distortion.size() && camera.distortion.back() != 0)
    text << "  # Kalibr's model ends here; this camera's next coefficient is "
         << exact(camera.distortion.back()) << "\n";
  text << "  intrinsics: " << list(std::vector<double>{camera.fx, camera.fy, camera.cx, camera.cy}) << "\n"
       << "  resolution: [" << camera.width << ", " << camera.height << "]\n"
       << (delay_s == 0 ? "" : "  line_delay_s: " + exact(delay_s) + "\n") << "  rostopic: /cam0/image_raw\n"
       << "  # x_cam = T_cam_imu x_imu\n  T_cam_imu:\n"
       << transformRows(kept.R_CI, -kept.R_CI * kept.p_IC, "  ")
       << "  # The other way, x_imu = T_imu_cam x_cam:\n"
       << transformRows(R_IC, kept.p_IC, "  #   ") << "  # t_imu = t_cam + timeshift_cam_imu [s]\n"
       << "  timeshift_cam_imu: " << exact(kept.timeshift_s) << "\n";
  return text.str();
}

std::string kalibrImu(const CalibrationInput& input, const CalibrationResult& result,
                      const CalibrationSubject& subject) {
  std::ostringstream text;
  text << origin(subject) << "# Noise densities as configured; the residuals are "
       << rounded(result.imu_sigma_scale) << " times as large.\n"
       << "accelerometer_noise_density: " << exact(input.noise.accel_noise_density) << "  # m/s^2/sqrt(Hz)\n"
       << "accelerometer_random_walk: " << exact(input.noise.accel_random_walk) << "  # m/s^3/sqrt(Hz)\n"
       << "gyroscope_noise_density: " << exact(input.noise.gyro_noise_density) << "  # rad/s/sqrt(Hz)\n"
       << "gyroscope_random_walk: " << exact(input.noise.gyro_random_walk) << "  # rad/s^2/sqrt(Hz)\n"
       << "rostopic: /imu0\nupdate_rate: " << rounded(imuRate(input)) << "  # Hz\n"
       << "# At the start of the recording (they change from one power-up to the next):\n"
       << "#   gyro bias [rad/s]: " << list(result.values.gyro_bias) << "\n"
       << "#   accelerometer bias [m/s^2]: " << list(result.values.accel_bias) << "\n";
  return text.str();
}

std::string onlineCalibration(const CalibrationInput& input, const CalibrationResult& result,
                              const CalibrationSubject& subject) {
  std::ostringstream text;
  text << origin(subject)
       << "# Include it after the vehicle's own file:  include: [vehicle.yaml, calibration.yaml]\n#\n";
  for (const ParameterReport& report : result.parameters) text << verdictComment(result, report.name.c_str());
  text << "# Refused parameters are left out, so that the vehicle's own value stays.\n";
  if (isKept(result, "plane.height_m"))
    text << "# plane: of the first frame of this recording; remove it for flights that start elsewhere.\n";
  FoundKeys found;
  setExtrinsics(result, found);
  setSensorErrors(result, found);
  setBiasSigmas(input, result, found);
  // Vibration and the model leave an error that no estimate removes.
  constexpr double kRotationFloor_deg = 0.02;
  found.set("inertial.extrinsic_rotation_sigma_deg",
            found.configuration.inertial.extrinsic_rotation_sigma_deg,
            std::max(result.values.rotation_sigma_rad / kDegree, kRotationFloor_deg));
  text << found.yaml();
  return text.str();
}

std::string verdictJson(const CalibrationResult& result, const CalibrationSubject& subject) {
  nlohmann::ordered_json json;
  json["vehicle"] = subject.vehicle;
  json["source"] = subject.source;
  json["frames"] = result.frames;
  json["frames_given"] = result.frames_given;
  json["measurements"] = result.measurements;
  json["duration_s"] = result.duration_s;
  json["points_rms_px"] = result.points_rms_px;
  json["vision_sigma_scale"] = result.vision_sigma_scale;
  json["imu_sigma_scale"] = result.imu_sigma_scale;
  json["misfit_sigma_scale"] = result.misfit_sigma_scale;
  json["halves_sigma_scale"] = result.halves_sigma_scale;
  json["frames_spanned"] = result.frames_spanned;
  for (const ParameterReport& report : result.parameters) {
    auto& entry = json["parameters"][report.name];
    entry["status"] = toString(report.verdict);
    entry["explanation"] = report.explanation;
    entry["unit"] = report.unit;
    entry["value"] = report.value;
    entry["sigma"] = report.sigma;
    entry["nominal"] = report.nominal;
  }
  json["R_CI"] = rowByRow(result.values.estimated.R_CI);
  const calibration::Excitation& excitation = result.excitation;
  json["excitation"]["rotation_rad_s"] =
      std::vector<double>(excitation.rotation.data(), excitation.rotation.data() + 3);
  json["excitation"]["rate_correlation"] = excitation.rotation_correlation;
  json["excitation"]["acceleration_m_s2"] = excitation.acceleration;
  std::vector<double> singular_values;
  for (int i = 2; i >= 0; --i) singular_values.push_back(1.0 / excitation.rotation_sigmas(i));
  json["R_CI_singular_values_1_rad"] = singular_values;
  for (const calibration::SplitHalfEntry& entry : result.split_half) {
    json["split_half"][entry.name] = {
        {"difference", entry.difference}, {"sigma", entry.sigma}, {"unit", entry.unit}};
  }
  json["warnings"] = result.warnings;
  return json.dump(2) + "\n";
}

}  // namespace redbee
