#include "redbee/geolocation/local_frame.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace redbee {
namespace {

constexpr double kEarthRadius_m = 6.371e6;
constexpr double kLocalSigma_m = 1;      // of the estimator's position, which no message states
constexpr double kDrift_m_s = 0.3;       // of the estimator's position, without a fix
constexpr double kMostDistance_m = 1e6;  // from the origin: beyond, the plane is none

Eigen::Matrix2d isotropic(double sigma_m) { return sigma_m * sigma_m * Eigen::Matrix2d::Identity(); }

}  // namespace

void LocalFrame::anchor(const Geodetic& at, const Eigen::Vector2d& position) {
  const GeographicLib::LocalCartesian here(at.latitude_deg, at.longitude_deg);
  double latitude = 0, longitude = 0, height = 0;
  here.Reverse(-position.x(), -position.y(), 0, latitude, longitude, height);
  origin_.emplace(latitude, longitude);
}

LocalFrame::Place LocalFrame::globalPlace(const VehiclePose& pose) {
  std::vector<double> M(9);
  double x = 0, y = 0, z = 0;
  origin_->Forward(pose.global->latitude_deg, pose.global->longitude_deg, 0, x, y, z, M);
  // M turns the place's east, north, up into the origin's; of it the turn about the vertical counts, the rest
  // is the curvature that a plane does not have.
  return {{x, y}, pose.position_covariance, std::atan2(M[3] - M[1], M[0] + M[4])};
}

std::optional<LocalFrame::Place> LocalFrame::placeOf(const VehiclePose& pose) {
  const bool has_local = pose.local.has_value();
  const Eigen::Vector2d local = has_local ? Eigen::Vector2d(pose.local->head<2>()) : Eigen::Vector2d::Zero();
  if (pose.global) {
    if (!origin_) {
      // Targets keep their places where the frame so far is known in the new one.
      has_restarted_ = has_begun_ && !has_local;
      anchor(*pose.global, local);
    }
    Place place = globalPlace(pose);
    if (place.position.norm() > kMostDistance_m) {
      has_restarted_ = true;
      anchor(*pose.global, local);
      place = globalPlace(pose);
    }
    if (has_local) from_local_ = place.position - local;
    covariance_ = place.covariance;
    fix_time_ = pose.time;
    has_begun_ = true;
    return place;
  }
  if (!has_local || (origin_ && !from_local_)) return std::nullopt;
  has_begun_ = true;
  if (!origin_) return Place{local, isotropic(kLocalSigma_m), 0};
  const double without_fix_s = std::abs(seconds(pose.time - fix_time_));
  return Place{local + *from_local_, covariance_ + isotropic(kDrift_m_s * without_fix_s), 0};
}

Geodetic LocalFrame::geodeticOf(const Eigen::Vector2d& position) const {
  Geodetic place;
  double height = 0;
  origin_->Reverse(position.x(), position.y(), -position.squaredNorm() / (2 * kEarthRadius_m),
                   place.latitude_deg, place.longitude_deg, height);
  return place;
}

Eigen::Vector2d LocalFrame::positionOf(const Geodetic& place) const {
  double x = 0, y = 0, z = 0;
  origin_->Forward(place.latitude_deg, place.longitude_deg, 0, x, y, z);
  return {x, y};
}

bool LocalFrame::takeRestart() { return std::exchange(has_restarted_, false); }

}  // namespace redbee
