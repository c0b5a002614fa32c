// From the autopilot's messages to measurements: units, axes, and what several messages say together.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <optional>

#include "redbee/geometry/time.hpp"
#include "redbee/mavlink/camera_messages.hpp"
#include "redbee/mavlink/measurements.hpp"
#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/parameters.hpp"
#include "redbee/mavlink/sensor_messages.hpp"

namespace redbee::mavlink {

/// std::nullopt where a message does not hold what it must: gyro and accelerometer, each with a new value.
std::optional<ImuReading> readingOf(const HighresImu& message, ImuTime time);
std::optional<ImuReading> readingOf(const RawImu& message, ImuTime time);
std::optional<ImuReading> readingOf(const ScaledImu2& message, ImuTime time);

/// Holds the latest of each message. Times are on our clock, whatever the order of arrival.
class VehicleState {
 public:
  explicit VehicleState(const AutopilotParameters& parameters) : parameters_(parameters) {}

  void note(const GpsRawInt& message, ImuTime time);
  void note(const GlobalPositionInt& message, ImuTime time);
  void note(const LocalPositionNed& message, ImuTime time);
  /// The pose then: position and velocity carried on from their last message, where that is at most a second
  /// older.
  std::optional<Pose> poseAt(const AttitudeQuaternion& message, ImuTime time);

  /// Height along the vertical from the distance along the beam; std::nullopt unless the sensor faces down,
  /// its reading is within its range, and the attitude is known and within 30 degrees of level.
  std::optional<HeightReading> heightOf(const DistanceSensor& message, ImuTime time) const;

  /// Against the body where the attitude is known; against north where either sender knows the heading.
  std::optional<GimbalAttitude> gimbalOf(const GimbalDeviceAttitudeStatus& message, ImuTime time) const;
  std::optional<GimbalAttitude> gimbalOf(const MountOrientation& message, ImuTime time) const;

  void note(const CameraInformation& message);
  /// The focal length is that of CAMERA_INFORMATION: it holds while the zoom is at its wide end or unknown.
  Lens lensOf(const CameraSettings& message, ImuTime time) const;
  /// Of a lens without distortion, whatever the image's width; std::nullopt where the field of view is
  /// unknown.
  static std::optional<Lens> lensOf(const CameraFovStatus& message, ImuTime time);

 private:
  template <typename Value>
  struct Timed {
    ImuTime time;
    Value value;
  };
  template <typename Value>
  static bool isFresh(const std::optional<Timed<Value>>& of, ImuTime now) {
    constexpr Duration kFreshFor = std::chrono::seconds(1);
    return of && now - of->time <= kFreshFor && of->time - now <= kFreshFor;
  }

  Eigen::Matrix3d attitudeCovariance() const;
  Eigen::Matrix3d positionCovariance() const;
  double velocitySigma() const;
  void addMotion(Pose& pose) const;
  /// The last one, carried on by its rate. Precondition: there is one.
  Eigen::Quaterniond attitudeAt(ImuTime time) const;
  GimbalAttitude gimbalFrom(const Eigen::Quaterniond& ned_from_gimbal, ImuTime time) const;

  AutopilotParameters parameters_;
  std::optional<Timed<GpsRawInt>> gps_;
  std::optional<Timed<GlobalPositionInt>> global_;
  std::optional<Timed<LocalPositionNed>> local_;
  std::optional<Timed<Eigen::Quaterniond>> attitude_;    ///< FRD to NED
  Eigen::Vector3d body_rate_ = Eigen::Vector3d::Zero();  ///< rad/s, FRD, at its time
  std::optional<CameraInformation> camera_;
};

}  // namespace redbee::mavlink
