// Offline camera-IMU calibration, from a flight over flat ground or from views of a known target.
//
// Estimated: R_CI, time shift, lever arm, gyro and accelerometer bias, and over ground the height at the
// first frame, the plane's tilt against gravity and a rolling shutter's line delay; and the gyro's scale and
// misalignment. A parameter that the recording does not make observable
// is refused: it keeps its nominal value.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "redbee/calibration/rotation_alignment.hpp"
#include "redbee/calibration/verdict.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/inertial/imu.hpp"
#include "redbee/visual/homography_estimation.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace redbee::calibration {

/// what() is one line: why the recording cannot be calibrated.
class CalibrationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Points tracked from frame a to frame b; ideal pixels.
struct GroundMatch {
  CameraTime time_a{};
  CameraTime time_b{};
  PointTracks points;
};

/// Detected corners of a known rigid target in one image.
struct TargetView {
  CameraTime time{};
  std::vector<Eigen::Vector2d> pixels;   ///< raw
  std::vector<Eigen::Vector3d> corners;  ///< m, in the target's frame
};

struct MeasuredHeight {
  double height_m = 0;
  double sigma_m = 0.02;
};

struct CalibrationInput {
  CameraIntrinsics camera;
  InertialExtrinsics nominal;  ///< used for parameters that the recording does not make observable
  ImuNoise noise;
  double gravity = 9.81;           ///< m/s^2
  double gyro_bias_sigma = 0.01;   ///< rad/s, turn-on bias
  double accel_bias_sigma = 0.15;  ///< m/s^2, turn-on bias
  std::vector<ImuSample> imu;
  std::vector<AltitudeSample> altimeter;       ///< may be empty
  std::optional<MeasuredHeight> start_height;  ///< camera above ground at the first frame, measured by hand
  std::vector<CameraTime> frames;              ///< times of all frames
  std::vector<GroundMatch> ground;             ///< either this
  std::vector<TargetView> target;              ///< or this
  RansacParameters ransac;
};

/// Nominal, estimated and kept values. `kept` has the estimated value of what was found or is weak, the
/// nominal one of what was refused.
struct CalibratedValues {
  InertialExtrinsics nominal;
  InertialExtrinsics estimated;
  InertialExtrinsics kept;
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();   ///< rad/s in I, at the start
  Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();  ///< m/s^2 in I, at the start
  Eigen::Vector2d tilt_rad = Eigen::Vector2d::Zero();    ///< of the ground's normal, towards G's x and y
  double rotation_sigma_rad = 0;                         ///< of R_CI, about its least certain axis
  double line_delay_s = 0;                               ///< kept; 0 where a global shutter fits, too
  /// Kept: turns the gyro's rates, their bias taken off, into true ones; the identity where it fits, too.
  Eigen::Matrix3d gyro_correction = Eigen::Matrix3d::Identity();
};

/// Difference of the two halves' estimates and its standard deviation; only of parameters that are observable
/// in both.
struct SplitHalfEntry {
  std::string name;
  std::string unit;
  double difference = 0;  ///< largest over the parameter's entries
  double sigma = 0;       ///< of that difference
  int entries = 1;        ///< of the parameter
  double ratio() const { return sigma > 0 ? difference / sigma : 0; }
};

/// Excitation of the parameters by the recording.
struct Excitation {
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< rad/s, rms about the principal axes, descending
  double rate_variation = 0;                           ///< rad/s, rms of the turning rate about its mean
  double rotation_correlation = 0;                     ///< of camera and gyro rates at the best time shift
  double acceleration = 0;                             ///< m/s^2, rms of the drone's own (gravity taken off)
  Eigen::Vector3d rotation_sigmas =
      Eigen::Vector3d::Zero();  ///< rad, of R_CI along its principal directions, descending
};

/// Time series and scatter data for the report.
struct Diagnostics {
  RotationAlignment alignment;
  std::vector<double> pair_t_s;  ///< camera clock since the first frame
  std::vector<double>
      pair_error_before_px;  ///< mean transfer error of the predicted homography, nominal extrinsics
  std::vector<double> pair_error_after_px;         ///< the same with the estimated ones
  std::vector<Eigen::Vector2d> scatter_before_px;  ///< transfer errors of a sample of the points
  std::vector<Eigen::Vector2d> scatter_after_px;
  std::vector<double> bias_t_s;
  std::vector<Eigen::Vector3d> gyro_bias;   ///< rad/s
  std::vector<Eigen::Vector3d> accel_bias;  ///< m/s^2
  std::vector<double> frame_t_s;
  std::vector<double> height_m;  ///< camera above ground at each frame
};

struct CalibrationResult {
  CalibratedValues values;
  std::vector<ParameterReport> parameters;
  std::vector<SplitHalfEntry> split_half;  ///< empty if a half is too short
  Excitation excitation;
  double vision_sigma_scale =
      1;  ///< factor of the homographies' standard deviations that makes their residuals consistent
  double imu_sigma_scale = 1;  ///< the same of the IMU's
  /// Residuals far beyond tracking noise indicate a scene that is not planar; the reported deviations were
  /// multiplied by this factor.
  double misfit_sigma_scale = 1;
  double halves_sigma_scale = 1;  ///< the reported deviations were multiplied by this factor, by which the
                                  ///< halves differ more than expected
  int frames = 0;                 ///< used
  int frames_given = 0;
  int measurements = 0;    ///< homographies or target poses used
  int frames_spanned = 0;  ///< by these
  double duration_s = 0;
  double points_rms_px = 0;  ///< of the points or corners about their homographies or poses
  Diagnostics diagnostics;
  std::vector<std::string> warnings;  ///< one line each

  const ParameterReport& parameter(const std::string& name) const;
};

/// Throws CalibrationError unless the IMU covers enough of the frames; looks only at the times of both.
void requireCoverage(const CalibrationInput& input);

/// Throws CalibrationError if the input is insufficient: no IMU during the frames, too little texture, too
/// few frames. `progress` is called with the completed fraction, 0 to 1.
CalibrationResult calibrate(const CalibrationInput& input, const std::function<void(double)>& progress = {});

}  // namespace redbee::calibration
