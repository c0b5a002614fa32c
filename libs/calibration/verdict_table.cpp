#include "redbee/calibration/verdict_table.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

std::vector<double> list(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

template <typename Matrix>
double worstSigma(const Matrix& covariance) {
  return std::sqrt(std::max(Eigen::SelfAdjointEigenSolver<Matrix>(covariance).eigenvalues().maxCoeff(), 0.0));
}

template <typename Matrix>
ParameterReport vectorReport(const std::string& name, const std::string& unit, const Eigen::VectorXd& value,
                             const Eigen::VectorXd& nominal, const Matrix& covariance, double scale) {
  ParameterReport report;
  report.name = name;
  report.unit = unit;
  report.value = list(scale * value);
  report.nominal = list(scale * nominal);
  report.sigma = list(scale * covariance.diagonal().cwiseMax(0).cwiseSqrt());
  report.worst_sigma = scale * worstSigma(covariance);
  return report;
}

/// Below this the rotation is the gyro's noise, and deviations computed from it are meaningless.
constexpr double kLeastRateVariation = 0.01;  // rad/s

void refuseWithoutRotation(ParameterReport& report, const Excitation& excitation) {
  if (excitation.rate_variation >= kLeastRateVariation) return;
  report.verdict = Verdict::kRefused;
  report.explanation = "not observable in this recording: the camera hardly turns; the nominal value stays";
}

ParameterReport rotationReport(const CalibratedValues& values, const JointCovariance& covariance) {
  const Eigen::Vector3d turn = logSO3(values.estimated.R_CI * values.nominal.R_CI.transpose());
  auto report =
      vectorReport("camera.R_CI", "deg", turn, Eigen::Vector3d::Zero(), covariance.rotation, 1 / kDegree);
  report.found_below = 0.1;
  report.weak_below = 1.0;
  classify(report, "rotation about at least two axes");
  return report;
}

ParameterReport timeshiftReport(const CalibratedValues& values, const JointCovariance& covariance) {
  using Matrix1d = Eigen::Matrix<double, 1, 1>;
  auto report = vectorReport("camera.timeshift_s", "s", Matrix1d(values.estimated.timeshift_s),
                             Matrix1d(values.nominal.timeshift_s), Matrix1d(covariance.timeshift), 1);
  report.found_below = 0.001;
  report.weak_below = 0.005;
  classify(report, "quick changes of the turning rate");
  return report;
}

ParameterReport leverArmReport(const CalibratedValues& values, const JointCovariance& covariance) {
  auto report =
      vectorReport("camera.p_IC", "m", values.estimated.p_IC, values.nominal.p_IC, covariance.p_IC, 1);
  report.found_below = 0.01;
  report.weak_below = 0.03;
  classify(report, "strong rotation close to the ground");
  return report;
}

/// worst_sigma is relative to the height.
ParameterReport heightReport(const CalibratedValues& values, const JointCovariance& covariance,
                             bool applies) {
  using Matrix1d = Eigen::Matrix<double, 1, 1>;
  auto report = vectorReport("plane.height_m", "m", Matrix1d(values.estimated.start_height_m),
                             Matrix1d(values.nominal.start_height_m), Matrix1d(covariance.first_height), 1);
  if (!applies) {
    report.verdict = Verdict::kNotApplicable;
    report.explanation = "no ground in a recording of a target";
    return report;
  }
  report.worst_sigma /= values.estimated.start_height_m;
  report.found_below = 0.02;
  report.weak_below = 0.1;
  report.unit = "of the height";
  classify(report, "acceleration, an altimeter or a measured height (--height)");
  report.unit = "m";
  return report;
}

ParameterReport tiltReport(const CalibratedValues& values, const JointCovariance& covariance, bool applies) {
  auto report = vectorReport("plane.tilt", "deg", values.tilt_rad, Eigen::Vector2d::Zero(), covariance.tilt,
                             1 / kDegree);
  if (!applies) {
    report.verdict = Verdict::kNotApplicable;
    report.explanation = "no ground in a recording of a target";
    return report;
  }
  report.found_below = 0.3;
  report.weak_below = 1.0;
  classify(report, "turns about the vertical, which separate a tilted ground from a biased accelerometer");
  return report;
}

ParameterReport gyroBiasReport(const CalibratedValues& values, const JointCovariance& covariance) {
  auto report = vectorReport("gyro_bias", "deg/s", values.gyro_bias, Eigen::Vector3d::Zero(),
                             covariance.gyro_bias, 1 / kDegree);
  report.found_below = 0.05;
  report.weak_below = 0.25;
  classify(report, "texture and time");
  return report;
}

ParameterReport accelBiasReport(const CalibratedValues& values, const JointCovariance& covariance) {
  auto report = vectorReport("accel_bias", "m/s^2", values.accel_bias, Eigen::Vector3d::Zero(),
                             covariance.accel_bias, 1);
  report.found_below = 0.03;
  report.weak_below = 0.1;
  classify(report, "rotation against gravity");
  return report;
}

/// Errors of the read-out's duration that images do not show, and that spoil less than the correction mends.
constexpr double kFoundReadout_s = 0.001, kWeakReadout_s = 0.004;

ParameterReport lineDelayReport(const LineDelay& delay, const CalibrationInput& input) {
  ParameterReport report;
  report.name = "camera.line_delay_s";
  report.unit = "s";
  report.value = {delay.delay_s};
  report.nominal = {input.camera.line_delay_s};
  report.sigma = {delay.sigma_s};
  report.worst_sigma = delay.sigma_s;
  report.found_below = kFoundReadout_s / input.camera.height;
  report.weak_below = kWeakReadout_s / input.camera.height;
  if (!input.target.empty()) {
    report.verdict = Verdict::kNotApplicable;
    report.explanation = "only a flight over ground shows it";
    return report;
  }
  classify(report, "quick changes of the turning rate over ground that fills the image");
  return report;
}

ParameterReport gyroShapeReport(const GyroShape& gyro) {
  auto report = vectorReport("imu.gyro_correction", "", gyro.shape, Vector6d::Zero(), gyro.covariance, 1);
  report.worst_sigma = gyro.worstSigma();
  report.found_below = 0.004;  // of which a focal length's ordinary error is 0.0028
  report.weak_below = 0.01;
  classify(report, "strong rotation about all three axes");
  return report;
}

bool isEstimated(const ParameterReport& report) {
  return report.verdict == Verdict::kFound || report.verdict == Verdict::kWeak;
}

}  // namespace

void addSensorReports(LineDelay delay, GyroShape gyro, const CalibrationInput& input,
                      CalibrationResult& result) {
  const double scale = result.halves_sigma_scale * result.misfit_sigma_scale;
  delay.sigma_s *= scale;
  // What the lens' calibration leaves is no misfit of the recording.
  gyro.covariance = scale * scale * (gyro.covariance - gyro.lens_covariance) + gyro.lens_covariance;
  ParameterReport shutter = lineDelayReport(delay, input);
  if (shutter.verdict != Verdict::kNotApplicable) refuseWithoutRotation(shutter, result.excitation);
  CalibratedValues& values = result.values;
  values.line_delay_s = input.camera.line_delay_s;
  if (isEstimated(shutter)) {
    values.line_delay_s = delay.isSignificant() ? delay.delay_s : 0;
    if (!delay.isSignificant()) shutter.explanation += "; a global shutter fits";
  }
  ParameterReport axes = gyroShapeReport(gyro);
  refuseWithoutRotation(axes, result.excitation);
  if (isEstimated(axes)) {
    if (gyro.isSignificant()) {
      values.gyro_correction = gyro.correction();
    } else {
      axes.explanation += "; axes without an error fit";
    }
  }
  result.parameters.push_back(std::move(shutter));
  result.parameters.push_back(std::move(axes));
}

std::vector<ParameterReport> parameterReports(const CalibrationResult& result,
                                              const JointCovariance& covariance,
                                              const CalibrationInput& input) {
  const bool ground = input.target.empty();
  std::vector<ParameterReport> reports{
      rotationReport(result.values, covariance),     timeshiftReport(result.values, covariance),
      leverArmReport(result.values, covariance),     heightReport(result.values, covariance, ground),
      tiltReport(result.values, covariance, ground), gyroBiasReport(result.values, covariance),
      accelBiasReport(result.values, covariance)};
  constexpr int kNeedRotation = 3;  // R_CI, time shift, lever arm
  for (int i = 0; i < kNeedRotation; ++i)
    refuseWithoutRotation(reports[static_cast<size_t>(i)], result.excitation);
  return reports;
}

void keepOrRefuse(CalibrationResult& result) {
  const auto estimated = [&](const char* name) {
    const Verdict verdict = result.parameter(name).verdict;
    return verdict == Verdict::kFound || verdict == Verdict::kWeak;
  };
  CalibratedValues& values = result.values;
  values.kept = values.nominal;
  if (estimated("camera.R_CI")) values.kept.R_CI = values.estimated.R_CI;
  if (estimated("camera.timeshift_s")) values.kept.timeshift_s = values.estimated.timeshift_s;
  if (estimated("camera.p_IC")) values.kept.p_IC = values.estimated.p_IC;
  if (estimated("plane.height_m")) {
    values.kept.start_height_m = values.estimated.start_height_m;
    values.kept.start_height_sigma_m = values.estimated.start_height_sigma_m;
  }
}

}  // namespace redbee::calibration
