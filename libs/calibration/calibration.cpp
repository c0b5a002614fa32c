#include "redbee/calibration/calibration.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "redbee/calibration/diagnostics.hpp"
#include "redbee/calibration/flight_solution.hpp"
#include "redbee/calibration/gyro_shape.hpp"
#include "redbee/calibration/line_delay.hpp"
#include "redbee/calibration/recording.hpp"
#include "redbee/calibration/split_half.hpp"
#include "redbee/calibration/verdict_table.hpp"
#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

/// Closed-form results less certain than this are not used as initial values.
constexpr double kAcceptedHandEyeSigma_rad = 3.0 * kDegree;
constexpr double kAcceptedCorrelation = 0.5;
/// Ratio of residuals to independent tracking errors over ground that is flat but overgrown.
constexpr double kOrdinaryVisionScale = 2.0;

JointPriors priorsFor(const CalibrationInput& input, const Mounting& mounting) {
  JointPriors priors;
  priors.q_CI = Eigen::Quaterniond(mounting.R_CI);
  priors.rotation_sigma_rad = 5.0 * kDegree;
  priors.p_IC = input.nominal.p_IC;
  priors.p_IC_sigma_m = 0.05;
  priors.timeshift_s = input.nominal.timeshift_s;
  priors.timeshift_sigma_s = 0.03;
  priors.gyro_bias_sigma = input.gyro_bias_sigma;
  priors.accel_bias_sigma = input.accel_bias_sigma;
  priors.tilt_sigma_rad = 3.0 * kDegree;
  priors.height_m = input.nominal.start_height_m;
  return priors;
}

/// Values from the rotations, and the nominal ones for what they do not determine.
Mounting mountingFrom(const RotationAlignment& alignment, const CalibrationInput& input) {
  Mounting mounting;
  mounting.R_CI = input.nominal.R_CI;
  mounting.p_IC = input.nominal.p_IC;
  mounting.timeshift_s = input.nominal.timeshift_s;
  if (!alignment.possible || alignment.correlation < kAcceptedCorrelation) return mounting;
  mounting.timeshift_s = alignment.timeshift_s;
  if (alignment.hand_eye.sigma.maxCoeff() > kAcceptedHandEyeSigma_rad) return mounting;
  mounting.R_CI = alignment.hand_eye.R_CI;
  mounting.rotation_sigma_rad = std::max(2.0 * alignment.hand_eye.sigma.maxCoeff(), 0.2 * kDegree);
  mounting.gyro_bias = alignment.hand_eye.gyro_bias;
  return mounting;
}

void fillValues(CalibrationResult& result, const FlightSolution& solution, const JointCovariance& covariance,
                const CalibrationInput& input) {
  const JointState& state = solution.state;
  CalibratedValues& values = result.values;
  values.nominal = input.nominal;
  values.estimated.R_CI = state.q_CI.toRotationMatrix();
  values.estimated.p_IC = state.p_IC;
  values.estimated.timeshift_s = state.timeshift_s;
  if (input.target.empty()) {
    values.estimated.start_height_m = cameraHeight(state, 0);
    values.estimated.start_height_sigma_m = std::sqrt(covariance.first_height);
  } else {
    values.estimated.start_height_m = input.nominal.start_height_m;
    values.estimated.start_height_sigma_m = input.nominal.start_height_sigma_m;
  }
  values.gyro_bias = state.biases.front().gyro;
  values.accel_bias = state.biases.front().accel;
  values.tilt_rad = state.tilt;
}

void fillExcitation(CalibrationResult& result, const FlightSolution& solution,
                    const JointCovariance& covariance, const RotationAlignment& alignment) {
  Excitation& excitation = result.excitation;
  excitation.rotation = alignment.hand_eye.excitation;
  excitation.rate_variation = alignment.rate_variation;
  excitation.rotation_correlation = alignment.correlation;
  excitation.acceleration = accelerationExcitation(solution.state);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance.rotation);
  excitation.rotation_sigmas = eigen.eigenvalues().cwiseMax(0).cwiseSqrt().reverse();
  result.values.rotation_sigma_rad = excitation.rotation_sigmas(0);
}

void fillFit(CalibrationResult& result, const FlightSolution& solution, const Recording& recording,
             const CalibrationInput& input) {
  result.vision_sigma_scale = std::sqrt(solution.input.vision_variance_scale);
  result.imu_sigma_scale = std::sqrt(solution.input.imu_variance_scale);
  result.frames = static_cast<int>(recording.t_cam_s.size());
  result.frames_given = static_cast<int>(input.frames.size());
  result.duration_s = recording.t_cam_s.back() - recording.t_cam_s.front();
  double squares = 0, count = 0;
  std::set<size_t> spanned;
  for (const GroundHomography& ground : solution.input.ground) {
    for (size_t k = ground.a; k < ground.b; ++k) spanned.insert(k);
  }
  for (const TargetPose& pose : solution.input.target) spanned.insert(pose.frame);
  result.frames_spanned = static_cast<int>(spanned.size());
  for (const GroundHomography& ground : solution.input.ground) {
    squares += ground.points * ground.rms_px * ground.rms_px;
    count += ground.points;
  }
  for (const TargetPose& pose : solution.input.target) {
    squares += pose.rms_px * pose.rms_px;
    count += 1;
  }
  result.points_rms_px = count > 0 ? std::sqrt(squares / count) : 0.0;
  result.measurements = static_cast<int>(solution.input.ground.size() + solution.input.target.size());
}

struct Solved {
  Recording recording;
  RotationAlignment alignment;
  FlightSolution solution;
};

Solved solve(const CalibrationInput& input) {
  Solved solved;
  solved.recording = prepareRecording(input);
  solved.alignment = alignRotations(rotationsOf(solved.recording), *solved.recording.imu);
  const Mounting mounting = mountingFrom(solved.alignment, input);
  solved.solution =
      solveFlight(solved.recording, input, mounting, priorsFor(input, mounting), input.start_height);
  return solved;
}

/// What makes images and gyro disagree beside the joint problem's parameters.
struct SensorErrors {
  LineDelay line_delay;
  GyroShape gyro;

  /// Those that the sensors must have.
  SensorErrors significant() const {
    SensorErrors taken = *this;
    if (!line_delay.isSignificant()) taken.line_delay.delay_s = 0;
    if (!gyro.isSignificant()) taken.gyro.shape.setZero();
    return taken;
  }
  bool areNone() const { return line_delay.delay_s == 0 && gyro.shape.isZero(0); }
  /// `rest`: what is left after these were taken out.
  SensorErrors with(SensorErrors rest) const {
    rest.line_delay.delay_s += line_delay.delay_s;
    rest.gyro.shape += gyro.shape;
    return rest;
  }
};

SensorErrors sensorErrors(const Solved& solved) {
  return {estimateLineDelay(solved.recording, solved.solution.state),
          estimateGyroShape(solved.alignment.rates, solved.alignment.hand_eye)};
}

/// `given`: of the input; `solved`: of the input or of a corrected one.
CalibrationInput withoutSensorErrors(const CalibrationInput& input, Recording given, const Solved& solved,
                                     const SensorErrors& errors) {
  given.imu = solved.recording.imu;
  CalibrationInput corrected = input;
  corrected.ground = withoutLineDelay(input, given, solved.solution.state, errors.line_delay.delay_s);
  const Eigen::Matrix3d correction = errors.gyro.correction();
  for (ImuSample& sample : corrected.imu) sample.gyro = correction * sample.gyro;
  return corrected;
}

void addWarnings(CalibrationResult& result) {
  if (result.frames < result.frames_given) {
    result.warnings.push_back("used " + std::to_string(result.frames) + " of " +
                              std::to_string(result.frames_given) +
                              " frames: the IMU does not cover the others without a gap");
  }
  if (4 * result.frames_spanned < 3 * result.frames) {
    result.warnings.push_back("only " + std::to_string(result.frames_spanned) + " of " +
                              std::to_string(result.frames) +
                              " frames are measured: little texture, or little ground in view");
  }
  if (result.imu_sigma_scale > 3) {
    result.warnings.push_back("the IMU is noisier than its configured densities, by " +
                              std::to_string(static_cast<int>(std::lround(result.imu_sigma_scale))) +
                              " times");
  }
  if (result.misfit_sigma_scale > 1.5) {
    result.warnings.push_back(
        "the points do not lie on one level plane: facades, slopes or bushes in view; deviations inflated");
  }
  for (const SplitHalfEntry& entry : result.split_half) {
    if (entry.ratio() <= 4) continue;
    result.warnings.push_back("the two halves of the recording disagree about " + entry.name);
  }
}

}  // namespace

const ParameterReport& CalibrationResult::parameter(const std::string& name) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const ParameterReport& report) { return report.name == name; });
  if (found == parameters.end()) throw CalibrationError("no parameter " + name);
  return *found;
}

CalibrationResult calibrate(const CalibrationInput& input, const std::function<void(double)>& progress) {
  const auto done = [&](double fraction) {
    if (progress) progress(fraction);
  };
  Solved solved = solve(input);
  done(0.4);
  if (!solved.solution.usable) {
    throw CalibrationError("the joint problem has no solution: images and IMU are inconsistent");
  }
  SensorErrors errors = sensorErrors(solved);
  // The motion that a first line delay is taken out by is still that of the disturbed points.
  const Recording given = solved.recording;
  std::array<CalibrationInput, 2> corrected;  // they outlive the recordings that refer to them
  for (CalibrationInput& next : corrected) {
    const SensorErrors taken = errors.significant();
    if (taken.areNone()) break;
    next = withoutSensorErrors(input, given, solved, taken);
    Solved again = solve(next);
    if (!again.solution.usable) break;
    const SensorErrors rest = sensorErrors(again);
    errors = taken.with(rest);
    solved = std::move(again);
    if (rest.significant().areNone()) break;
  }
  const auto& [recording, alignment, solution] = solved;
  done(0.7);

  CalibrationResult result;
  fillFit(result, solution, recording, input);
  result.split_half = splitHalf(recording, input, solution);
  result.halves_sigma_scale = disagreement(result.split_half);
  result.misfit_sigma_scale = std::max(1.0, result.vision_sigma_scale / kOrdinaryVisionScale);
  const double scale = result.halves_sigma_scale * result.misfit_sigma_scale;
  const JointCovariance covariance = solution.analysis.covariance.scaled(scale * scale);
  fillValues(result, solution, covariance, input);
  fillExcitation(result, solution, covariance, alignment);
  done(0.95);
  result.parameters = parameterReports(result, covariance, input);
  keepOrRefuse(result);
  addSensorReports(errors.line_delay, errors.gyro, input, result);
  result.diagnostics = diagnose(solution, recording, input, alignment);
  addWarnings(result);
  return result;
}

}  // namespace redbee::calibration
