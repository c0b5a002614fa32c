// A drone that watches one object on level ground, with errors of known distribution and exact truth.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "redbee/geolocation/geolocator.hpp"
#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::test {

struct Watch {
  double height_m = 50;
  double depression_deg = 45;
  double attitude_sigma_deg = 0.5;
  double position_sigma_m = 0;
  double height_sigma_m = 0.2;
  double error_correlation_s = 30;  ///< of the true errors that last
  double roll_deg = 0;
  double box_px = 30;
  double seconds = 5;
  double rate_hz = 10;
  Eigen::Vector2d velocity{1.5, -1};  ///< m/s, of the object
  double drone_speed = 4;             ///< m/s, across the line of sight
};

inline CameraIntrinsics watchingCamera() { return {1280, 720, 1000, 1000, 639.5, 359.5, {}}; }

inline GeolocationParameters watchParameters() {
  GeolocationParameters parameters;
  parameters.enabled = true;
  parameters.mount_sigma_deg = 0.1;
  parameters.ground_slope_sigma_deg = 0;
  parameters.acceleration_sigma = 0.1;
  return parameters;
}

/// Camera to east, north, up: looks north, `depression` below the horizon, turned about its axis by `roll`.
inline Eigen::Matrix3d lookingNorth(double depression_rad, double roll_rad) {
  Eigen::Matrix3d level;  // columns: the camera's right, down, forward in E
  level << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return Eigen::AngleAxisd(-depression_rad, Eigen::Vector3d::UnitX()).toRotationMatrix() * level *
         Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

inline std::optional<Eigen::Vector2d> pixelOf(const CameraModel& camera, const GroundView& view,
                                              const Eigen::Vector3d& point) {
  const Eigen::Vector3d from(view.position.x(), view.position.y(), view.height_m);
  return camera.project(view.R_EC.transpose() * (point - from));
}

/// The box of this extent whose foot is at `foot`.
inline ImageBox boxStandingAt(const Eigen::Vector2d& foot, double extent_px, const CameraModel& camera,
                              const GroundView& view, double height_over_length) {
  ImageBox box{0, 0, extent_px, extent_px};
  Eigen::Vector2d centre = foot;
  const Eigen::Vector3d down = -view.R_EC.row(2).transpose();
  for (int i = 0; i < 20; ++i) {
    box.x = centre.x() - (box.width - 1) / 2;
    box.y = centre.y() - (box.height - 1) / 2;
    centre += foot - footOf(box, camera, down, height_over_length).value().pixel;
  }
  return box;
}

/// Errors that last: first-order Gauss-Markov processes of unit variance.
class LastingErrors {
 public:
  explicit LastingErrors(std::mt19937& random) : random_(random) {
    for (double& error : errors_) error = normal_(random_);
  }
  void advance(double dt, double correlation_s) {
    const double left = std::exp(-dt / correlation_s);
    for (double& error : errors_) error = left * error + std::sqrt(1 - left * left) * normal_(random_);
  }
  Eigen::Vector2d pair(int first) const { return {errors_[first], errors_[first + 1]}; }
  Eigen::Vector3d triple(int first) const { return {errors_[first], errors_[first + 1], errors_[first + 2]}; }
  double operator[](int i) const { return errors_[i]; }

 private:
  std::mt19937& random_;
  std::normal_distribution<double> normal_;
  double errors_[7] = {};
};

struct WatchOutcome {
  std::optional<Target> target;
  Eigen::Vector2d position_error = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_error = Eigen::Vector2d::Zero();
  int gaps = 0;  ///< frames without exactly one target
};

/// One flight: what the geolocator says in the end against the truth.
inline WatchOutcome fly(const Watch& watch, const GeolocationParameters& parameters, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto camera = makeCameraModel(watchingCamera());
  Geolocator geolocator(watchingCamera(), parameters);
  LastingErrors errors(random), foot_errors(random);
  const double focal_error = normal(random) * parameters.focal_sigma;
  CameraIntrinsics true_intrinsics = watchingCamera();
  true_intrinsics.fx /= 1 + focal_error;
  true_intrinsics.fy /= 1 + focal_error;
  const auto true_camera = makeCameraModel(true_intrinsics);
  const double attitude_sigma = std::hypot(watch.attitude_sigma_deg, parameters.mount_sigma_deg) * kDegree;
  const int frames = static_cast<int>(watch.seconds * watch.rate_hz);
  const double dt = 1 / watch.rate_hz;
  const double away_m = watch.height_m / std::tan(watch.depression_deg * kDegree);
  WatchOutcome outcome;
  Eigen::Vector2d object(0, 0), velocity = watch.velocity;
  for (int k = 0; k < frames; ++k) {
    const double t = k * dt;
    GroundView truth;
    truth.R_EC = lookingNorth(watch.depression_deg * kDegree, watch.roll_deg * kDegree);
    truth.position = object + Eigen::Vector2d(0.05 * watch.height_m * std::sin(t), -away_m) +
                     Eigen::Vector2d(0, 0.01 * watch.drone_speed * t);
    truth.height_m = watch.height_m;
    GroundView measured = truth;
    measured.R_EC = expSO3(attitude_sigma * errors.triple(0)) * truth.R_EC;
    measured.attitude_covariance =
        std::pow(watch.attitude_sigma_deg * kDegree, 2) * Eigen::Matrix3d::Identity();
    measured.position += watch.position_sigma_m * errors.pair(3);
    measured.position_covariance = std::pow(watch.position_sigma_m, 2) * Eigen::Matrix2d::Identity();
    measured.height_m += watch.height_sigma_m * errors[5];
    measured.height_sigma_m = watch.height_sigma_m;
    const auto foot = pixelOf(*true_camera, truth, {object.x(), object.y(), 0});
    const Eigen::Vector2d noise =
        parameters.pixel_sigma_px * Eigen::Vector2d(normal(random), normal(random)) +
        parameters.foot_sigma * watch.box_px * foot_errors.pair(0);
    const ImageBox box =
        boxStandingAt(foot.value() + noise, watch.box_px, *camera, measured, parameters.height_over_length);
    const auto targets = geolocator.step(CameraTime(fromSeconds(100 + k * dt)), measured, {{7, box, true}});
    outcome.gaps += targets.size() == 1 ? 0 : 1;
    outcome.target = targets.empty() ? std::nullopt : std::optional(targets.front());
    if (outcome.target) {
      outcome.position_error = outcome.target->position - object;
      outcome.velocity_error = outcome.target->velocity - velocity;
    }
    object += velocity * dt;
    velocity +=
        parameters.acceleration_sigma * std::sqrt(dt) * Eigen::Vector2d(normal(random), normal(random));
    errors.advance(dt, watch.error_correlation_s);
    foot_errors.advance(dt, 1);
  }
  return outcome;
}

}  // namespace redbee::test
