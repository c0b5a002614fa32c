// The messages of the camera's motion.
#include <Eigen/LU>

#include "redbee/geometry/row_major.hpp"
#include "redbee/node/covariance_check.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/node/message_limits.hpp"

namespace redbee {
namespace {

using namespace message_limits;  // NOLINT: made for this

Eigen::Matrix3d matrix(const double (&entries)[9]) { return Eigen::Map<const RowMajor3d>(entries); }

/// Neither mirrors the image nor collapses it.
bool isHomography(const double (&entries)[9]) {
  return areFrom(-kMaxEntry, entries, kMaxEntry) && std::abs(entries[8] - 1) <= kUnitTolerance &&
         matrix(entries).determinant() > kMinDeterminant;
}

bool isRotation(const double (&entries)[9]) {
  if (!areFrom(-2, entries, 2)) return false;
  const Eigen::Matrix3d R = matrix(entries);
  return (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kUnitTolerance &&
         R.determinant() > 0;
}

/// 0 where it is not known.
bool isZoom(double zoom) { return zoom == 0 || isFrom(1 / kMaxZoom, zoom, kMaxZoom); }

bool isUnit(const double (&v)[3]) {
  return areFrom(-2, v, 2) && std::abs(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1) <= kUnitTolerance;
}

/// Inliers and outliers.
template <typename Message>
bool hasPointCounts(const Message& m) {
  return isFrom(0, m.inliers, kMaxPoints) && isFrom(0, m.outliers, kMaxPoints);
}

const char* firstOf(const char* fault, const char* other) { return fault != nullptr ? fault : other; }

}  // namespace

const char* faultOf(const homography_t& m) {
  return firstFault({{isHomography(m.H), "homography"}, {isCovariance(m.covariance), "covariance"}});
}

const char* faultOf(const plane_motion_t& m) {
  return firstFault({{isRotation(m.R), "rotation"},
                     {areFrom(-kMaxLength_m, m.t, kMaxLength_m), "translation"},
                     {isUnit(m.normal), "normal"},
                     {m.distance > 0 && isFrom(0, m.distance, kMaxLength_m), "distance"}});
}

const char* faultOf(const row_motion_t& m) {
  if (m.valid == 0) return nullptr;
  return firstFault({{isFlag(m.valid), "flag"},
                     {areFrom(-kMaxRotationRate, m.rate, kMaxRotationRate), "rotation rate of the rows"},
                     {areFrom(-kMaxRotationAcceleration, m.acceleration, kMaxRotationAcceleration),
                      "rotation acceleration of the rows"},
                     {areFrom(-kMaxSpeed_m_s, m.velocity, kMaxSpeed_m_s), "velocity of the rows"},
                     {isUnit(m.normal), "normal of the rows"}});
}

const char* faultOf(const tracks_t& m) {
  const auto n = static_cast<size_t>(std::max(0, m.n));
  const auto is_inside = [](const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float value) {
      return isFrom(-kMaxCoordinate_px, double{value}, kMaxCoordinate_px);
    });
  };
  const bool agree = m.x_previous.size() == n && m.y_previous.size() == n && m.x.size() == n &&
                     m.y.size() == n && m.inlier.size() == n;
  return firstFault(
      {{isFrom(0, m.n, kMaxPoints) && agree, "number of tracks"},
       {is_inside(m.x_previous) && is_inside(m.y_previous) && is_inside(m.x) && is_inside(m.y), "tracks"}});
}

const char* faultOf(const earlier_step_t& m) {
  if (m.valid == 0) return nullptr;
  return firstOf(firstFault({{isFlag(m.valid), "flag"},
                             {hasFrameTimes(m) && m.utime_previous < m.utime, "time of the earlier step"},
                             {isZoom(m.zoom), "zoom"},
                             {hasPointCounts(m), "points"}}),
                 faultOf(m.ground));
}

const char* faultOf(const inertial_homography_t& m) {
  const char* fault =
      firstFault({{hasFrameTimes(m), "time"},
                  {m.sequence >= 0, "sequence"},
                  {isFrom(inertial_homography_t::GOOD, m.status, inertial_homography_t::UNCERTAIN), "status"},
                  {isFlag(m.valid), "flag"},
                  {hasImageSize(m), "image size"},
                  {isZoom(m.zoom), "zoom"},
                  {isFrom(0, m.feedback_test_ratio, kMaxTestRatio), "test ratio"}});
  fault = firstOf(fault, firstOf(faultOf(m.row_motion), faultOf(m.earlier)));
  if (fault != nullptr || m.valid == 0) return fault;
  fault = firstFault({{isCovariance(m.rotation_covariance), "covariance"},
                      {isUnit(m.down), "direction of gravity"},
                      {isFrom(0, m.camera_height, kMaxLength_m), "height"},
                      {isFrom(0, m.camera_height_sigma, kMaxSigma), "sigma"},
                      {areFrom(-kMaxRotationRate, m.gyro_bias, kMaxRotationRate), "gyro bias"},
                      {areFrom(-kMaxAcceleration, m.accel_bias, kMaxAcceleration), "accelerometer bias"}});
  return firstOf(fault, firstOf(faultOf(m.ground), faultOf(m.motion)));
}

const char* faultOf(const visual_homography_t& m) {
  const char* fault =
      firstFault({{hasFrameTimes(m), "time"},
                  {m.sequence >= 0, "sequence"},
                  {isFrom(visual_homography_t::GOOD, m.status, visual_homography_t::NO_IMAGE), "status"},
                  {hasImageSize(m), "image size"},
                  {isZoom(m.zoom), "zoom"},
                  {hasPointCounts(m) && isFrom(0, m.sampled, kMaxPoints), "points"},
                  {isFrom(0, m.rms, kMaxCoordinate_px), "residual"}});
  fault = firstOf(fault, firstOf(faultOf(m.tracks), faultOf(m.earlier)));
  if (fault != nullptr || m.status != visual_homography_t::GOOD) return fault;
  return faultOf(m.ground);
}

const char* faultOf(const fused_homography_t& m) {
  const char* fault = firstFault(
      {{hasFrameTimes(m), "time"},
       {isTime(m.utime_anchor) && m.utime_anchor <= m.utime, "time of the anchor"},
       {isTime(m.utime_tracks) && m.utime_tracks <= m.utime, "time of the tracks"},
       {m.sequence >= 0, "sequence"},
       {isFrom(fused_homography_t::NONE, m.source, fused_homography_t::FUSED), "source"},
       {m.epoch >= 0, "epoch"},
       {hasImageSize(m), "image size"},
       {isZoom(m.zoom), "zoom"},
       {isFlag(m.has_front) && isFlag(m.has_innovation) && isFlag(m.has_observation) && isFlag(m.has_motion),
        "flag"},
       {isTextShort(m.calibration), "text"},
       {m.has_front == 0 || isHomography(m.H_front), "front plane"},
       {m.has_front == 0 || isFrom(0, m.front_inliers, kMaxPoints), "points"},
       {m.has_innovation == 0 ||
            (areFrom(-kMaxEntry, m.innovation, kMaxEntry) && isCovariance(m.innovation_covariance) &&
             isFrom(0, m.test_ratio, kMaxTestRatio)),
        "innovation"}});
  fault = firstOf(fault, firstOf(faultOf(m.step), firstOf(faultOf(m.anchor), faultOf(m.tracks))));
  fault = firstOf(fault, faultOf(m.row_motion));
  if (fault == nullptr && m.has_observation != 0) fault = faultOf(m.observed);
  if (fault == nullptr && m.has_motion != 0) fault = faultOf(m.motion);
  return fault;
}

/// What a filter may start from is its own decision (libs/inertial/filter_snapshot.hpp).
const char* faultOf(const filter_snapshot_t& m) {
  return firstFault(
      {{isTime(m.utime), "time"},
       {isTextShort(m.configuration), "text"},
       {isFrom(0, m.height, kMaxLength_m), "height"},
       {isUnit(m.up), "vertical"},
       {areFrom(-kMaxSpeed_m_s, m.velocity, kMaxSpeed_m_s), "velocity"},
       {areFrom(-kMaxRotationRate, m.gyro_bias, kMaxRotationRate), "gyro bias"},
       {areFrom(-kMaxAcceleration, m.accel_bias, kMaxAcceleration), "accelerometer bias"},
       {isRotation(m.R_CI), "mounting"},
       {isFrom(0, m.height_sigma, kMaxSigma) && areFrom(0, m.up_sigma, kMaxSigma) &&
            areFrom(0, m.velocity_sigma, kMaxSigma) && areFrom(0, m.gyro_bias_sigma, kMaxSigma) &&
            areFrom(0, m.accel_bias_sigma, kMaxSigma) && areFrom(0, m.R_CI_sigma, kMaxSigma),
        "sigma"}});
}

}  // namespace redbee
