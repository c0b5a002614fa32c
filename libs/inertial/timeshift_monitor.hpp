// Whether the stamps of camera and IMU fit in flight, and by how much not: the time shift between vision's
// rotations and the gyro's over the last seconds, and its drift over minutes.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <string>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/imu.hpp"
#include "redbee/inertial/timeshift_fit.hpp"

namespace redbee {

class TimeshiftMonitor {
 public:
  struct Parameters {
    double window_s = 20;         ///< s of rotations that an estimate is made of
    double period_s = 2;          ///< s between estimates
    double min_span_s = 4;        ///< s of rotations before the first one
    double max_sigma_s = 0.003;   ///< s, a less certain estimate is none
    double tolerance_s = 0.01;    ///< s, by which a nominal time shift may be off (VisionAgreement's)
    double drift_memory_s = 300;  ///< s of estimates that the drift is made of
  };

  explicit TimeshiftMonitor(const InertialExtrinsics& extrinsics)
      : TimeshiftMonitor(extrinsics, Parameters()) {}
  TimeshiftMonitor(const InertialExtrinsics& extrinsics, const Parameters& parameters)
      : extrinsics_(extrinsics), parameters_(parameters) {}

  /// rad/s in I, in order of time; late ones are left out.
  void addGyro(ImuTime time, const Eigen::Vector3d& rate);
  /// Rotation of the camera from frame a to frame b by vision, in camera coordinates.
  void addVision(CameraTime a, CameraTime b, const Eigen::Matrix3d& R_ba);

  struct Drift {
    double rate;   ///< seconds a second
    double sigma;  ///< the same, one standard deviation
  };
  /// Beyond the configured time shift, at the last estimate; t_imu = t_cam + configured + shift. std::nullopt
  /// while the rotation of the last seconds does not show it.
  const std::optional<TimeshiftFit>& estimate() const { return estimate_; }
  /// std::nullopt before some estimates that share no rotations.
  std::optional<Drift> drift() const;
  /// Of the rotations seen [deg/s], a standard deviation over the window: what an estimate needs.
  double rotation_deg_s() const;
  /// One line for people: empty while the time shift fits or is not known. Changes at most once a period.
  const std::string& message() const { return message_; }

 private:
  struct Past {
    double time_s;
    TimeshiftFit fit;
  };

  double sinceOrigin(ImuTime time);
  void update();
  void keepForDrift(double now_s);
  void describe();

  InertialExtrinsics extrinsics_;
  Parameters parameters_;
  std::optional<ImuTime> origin_;
  GyroIntegral gyro_;
  std::deque<VisualRate> vision_;
  double updated_s_ = 0;
  std::optional<TimeshiftFit> estimate_;
  std::deque<Past> past_;
  bool is_off_ = false;
  std::string message_;
};

}  // namespace redbee
