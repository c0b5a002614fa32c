// The messages of a drone that watches one walker from 40 m, with exact truth on WGS-84.
#pragma once

#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <cstdint>

#include "redbee/altimeter_t.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/geolocation/foot_point.hpp"
#include "redbee/geolocation/vehicle_pose.hpp"
#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/camera_model.hpp"
#include "redbee/pose_t.hpp"

namespace redbee::test {

/// The drone flies east at 3 m/s; its camera, which is fixed to it, looks north, 45 degrees down. The walker
/// goes east at 3.5 m/s for 10 s, then stands: its identity is predicted, then no longer reported. Who walks
/// for longer goes at 3.5 and 2.5 m/s by turns of 40 s, and so stays in the image however long a flight
/// takes.
class TargetFlight {
 public:
  double walks_s = 10;     ///< s, then it stands
  double reported_s = 12;  ///< s, then its identity is no longer reported

  static constexpr double kRate_hz = 24;
  static constexpr double kHeight_m = 40;
  static constexpr double kTurn_s = 40;
  static constexpr int kId = 5;
  static constexpr double kHomeLatitude = 47.3, kHomeLongitude = 8.5, kHomeAltitude = 500;

  static Configuration configuration() {
    Configuration configuration;
    configuration.camera = {640, 480, 500, 500, 319.5, 239.5, {}};
    configuration.geolocation.enabled = true;
    configuration.geolocation.ground_slope_sigma_deg = 0;
    configuration.inertial.extrinsics.timeshift_s = 0.02;
    // From the body (forward, left, up) to the camera: 45 degrees down.
    const double c = std::sqrt(0.5);
    configuration.inertial.extrinsics.R_CI << 0, -1, 0, -c, 0, -c, c, 0, -c;
    configuration.inertial.extrinsics.p_IC.setZero();
    return configuration;
  }
  /// The same, as a vehicle file's lines.
  static const char* yaml() {
    return "camera: {width: 640, height: 480, fx: 500, fy: 500, cx: 319.5, cy: 239.5, distortion: [0, 0, 0, "
           "0],\n"
           "  R_CI: [0, -1, 0, -0.70710678118654752, 0, -0.70710678118654752, 0.70710678118654752, 0, "
           "-0.70710678118654752],\n"
           "  p_IC: [0, 0, 0], timeshift_s: 0.02}\n"
           "geolocation: {enabled: true, ground_slope_sigma_deg: 0}\n";
  }

  static Eigen::Vector2d dronePosition(double t) { return {3 * t, 0}; }
  Eigen::Vector2d walkerPosition(double t) const {
    const double walked_s = std::min(t, walks_s);
    const double ahead_m = 0.5 * (kTurn_s - std::abs(std::fmod(walked_s, 2 * kTurn_s) - kTurn_s));
    return {-10 + 3 * walked_s + ahead_m, 42};
  }
  static Geodetic placeOf(const Eigen::Vector2d& metres) {
    Geodetic place;
    GeographicLib::Geodesic::WGS84().Direct(kHomeLatitude, kHomeLongitude,
                                            std::atan2(metres.x(), metres.y()) / kDegree, metres.norm(),
                                            place.latitude_deg, place.longitude_deg);
    return place;
  }
  /// m, of a place from the walker.
  double missOf(double latitude, double longitude, double t) const {
    const Geodetic walker = placeOf(walkerPosition(t));
    double distance_m = 0;
    GeographicLib::Geodesic::WGS84().Inverse(latitude, longitude, walker.latitude_deg, walker.longitude_deg,
                                             distance_m);
    return distance_m;
  }

  static pose_t pose(int64_t utime, double t, bool has_global = true) {
    pose_t m{};
    m.utime = utime;
    m.quat[0] = std::sqrt(0.5);  // forward is north
    m.quat[3] = std::sqrt(0.5);
    for (const int i : {0, 4, 8}) {
      m.attitude_covariance[i] = std::pow(0.5 * kDegree, 2);
      m.position_covariance[i] = 1;
      m.velocity_covariance[i] = 0.01;
    }
    m.has_velocity = 1;
    m.velocity[0] = 3;
    m.has_global = m.has_home_altitude = has_global ? 1 : 0;
    const Geodetic place = placeOf(dronePosition(t));
    m.latitude = place.latitude_deg;
    m.longitude = place.longitude_deg;
    m.altitude = kHomeAltitude + kHeight_m;
    m.home_altitude = kHeight_m;
    m.has_local = 1;
    m.local[0] = dronePosition(t).x();
    m.local[1] = dronePosition(t).y();
    m.local[2] = kHeight_m;
    return m;
  }
  static altimeter_t altimeter(int64_t utime) { return {utime, kHeight_m, 0.1}; }
  /// `utime`: camera clock, which is 20 ms behind the IMU's.
  detections_t detections(int64_t utime, double t, int32_t sequence) const {
    detections_t m{};
    m.utime = utime;
    m.sequence = sequence;
    if (t > reported_s) return m;
    m.n = 1;
    m.detections.push_back(boxOf(t));
    return m;
  }

 private:
  detection_t boxOf(double t) const {
    static const auto camera = makeCameraModel(configuration().camera);
    const Eigen::Vector2d offset = walkerPosition(t) - dronePosition(t);
    const Eigen::Vector3d in_body(offset.y(), -offset.x(), -kHeight_m);
    const auto pixel = camera->project(configuration().inertial.extrinsics.R_CI * in_body).value();
    // The foot of a box seen at 45 degrees lies a quarter of its extent above its lower edge.
    detection_t d{};
    d.id = kId;
    d.width = 12;
    d.height = 16;
    d.x = static_cast<int32_t>(std::lround(pixel.x() - 5.5));
    d.y = static_cast<int32_t>(std::lround(pixel.y() - 11.5));
    d.area = 150;
    d.score = 0.9;
    d.seen = t <= walks_s ? 1 : 0;
    return d;
  }
};

}  // namespace redbee::test
