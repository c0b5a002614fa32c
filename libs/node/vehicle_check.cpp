// The messages of the autopilot, and of targets on the ground.
#include "redbee/node/covariance_check.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/node/message_limits.hpp"

namespace redbee {
namespace {

using namespace message_limits;  // NOLINT: made for this

constexpr double kMaxUnseen_s = 1e6;                          // s
constexpr double kMaxDrift = 0.01;                            // s/s
constexpr double kMaxRoundTrip_s = 60;                        // s
constexpr double kMaxFocal_px = 1e6;                          // px
constexpr int64_t kMaxOffset_ns = 4'000'000'000'000'000'000;  // the year 2096

bool isUnitQuaternion(const double (&q)[4]) {
  return areFrom(-2, q, 2) &&
         std::abs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1) <= kUnitTolerance;
}

bool isAltitude(double value) { return isFrom(-kMaxLength_m, value, kMaxLength_m); }

}  // namespace

const char* faultOf(const pose_t& m) {
  return firstFault(
      {{isTime(m.utime), "time"},
       {isUnitQuaternion(m.quat) && isCovariance(m.attitude_covariance), "attitude"},
       {isFlag(m.has_velocity) && isFlag(m.has_global) && isFlag(m.has_ellipsoid_altitude) &&
            isFlag(m.has_home_altitude) && isFlag(m.has_local),
        "flag"},
       {m.has_velocity == 0 ||
            (areFrom(-kMaxSpeed_m_s, m.velocity, kMaxSpeed_m_s) && isCovariance(m.velocity_covariance)),
        "velocity"},
       {m.has_global == 0 || (isFrom(-90, m.latitude, 90) && isFrom(-180, m.longitude, 180) &&
                              isAltitude(m.altitude) && isCovariance(m.position_covariance)),
        "position"},
       {m.has_ellipsoid_altitude == 0 || isAltitude(m.ellipsoid_altitude), "altitude above the ellipsoid"},
       {m.has_home_altitude == 0 || isAltitude(m.home_altitude), "altitude above home"},
       {m.has_local == 0 || areFrom(-kMaxEntry, m.local, kMaxEntry), "local position"}});
}

const char* faultOf(const gimbal_t& m) {
  return firstFault({{isTime(m.utime), "time"},
                     {isFlag(m.has_body) && isFlag(m.has_earth), "flag"},
                     {m.has_body == 0 || isUnitQuaternion(m.quat_body), "attitude against the body"},
                     {m.has_earth == 0 || isUnitQuaternion(m.quat_earth), "attitude against the earth"}});
}

const char* faultOf(const lens_t& m) {
  return firstFault(
      {{isTime(m.utime), "time"},
       {isFlag(m.has_zoom) && isFlag(m.has_focal_length), "flag"},
       {m.has_zoom == 0 || isFrom(0, m.zoom, 1), "zoom"},
       {m.has_focal_length == 0 || (m.focal_length > 0 && isFrom(0, m.focal_length, kMaxFocal_px) &&
                                    isFrom(1, m.width, kMaxImageSide)),
        "focal length"}});
}

const char* faultOf(const target_t& m) {
  return firstFault(
      {{m.id >= 0, "identity"},
       {isFrom(target_t::MOVING, m.state, target_t::COASTING), "state"},
       {isFrom(-90, m.latitude, 90) && isFrom(-180, m.longitude, 180), "place"},
       {areFrom(-kMaxEntry, m.position, kMaxEntry) && isCovariance(m.position_covariance), "position"},
       {areFrom(-kMaxSpeed_m_s, m.velocity, kMaxSpeed_m_s) && isCovariance(m.velocity_covariance),
        "velocity"},
       {areFrom(0, m.size, kMaxLength_m), "size"},
       {isFrom(0, m.range, kMaxEntry), "range"},
       {isFrom(0, m.unseen, kMaxUnseen_s), "time without being seen"}});
}

const char* faultOf(const targets_t& m) {
  const char* fault = firstFault(
      {{isTime(m.utime), "time"},
       {m.sequence >= 0, "sequence"},
       {isFrom(targets_t::GOOD, m.status, targets_t::OTHER_CAMERA), "status"},
       {isFlag(m.has_global) && isFlag(m.has_view) && isFlag(m.has_footprint) &&
            isFlag(m.has_ground_altitude),
        "flag"},
       {m.has_view == 0 || (areFrom(-kMaxEntry, m.camera_position, kMaxEntry) &&
                            isFrom(0, m.camera_height, kMaxLength_m) && areFrom(-2, m.camera_axis, 2)),
        "camera"},
       {m.has_footprint == 0 || areFrom(-kMaxEntry, m.footprint, kMaxEntry), "footprint"},
       {m.has_ground_altitude == 0 || isAltitude(m.ground_altitude), "altitude of the ground"},
       {isFrom(0, m.refused_horizon, kMaxDetections) && isFrom(0, m.refused_border, kMaxDetections),
        "refused boxes"},
       {isFrom(0, m.n, kMaxTargets) && m.targets.size() == static_cast<size_t>(m.n), "number of targets"}});
  for (size_t i = 0; fault == nullptr && i < m.targets.size(); ++i) fault = faultOf(m.targets[i]);
  return fault;
}

const char* faultOf(const clock_offset_t& m) {
  return firstFault({{isTime(m.utime), "time"},
                     {isFrom(-kMaxOffset_ns, m.offset, kMaxOffset_ns), "offset"},
                     {isFrom(-kMaxDrift, m.drift, kMaxDrift), "drift"},
                     {m.sigma > 0 && isFrom(0, m.sigma, kMaxRoundTrip_s), "sigma"},
                     {isFrom(0, m.round_trip, kMaxRoundTrip_s), "round trip"}});
}

}  // namespace redbee
