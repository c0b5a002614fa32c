// From boxes in images to targets on the ground.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "redbee/geolocation/foot_point.hpp"
#include "redbee/geolocation/ground_point.hpp"
#include "redbee/geolocation/ground_view.hpp"
#include "redbee/geolocation/parameters.hpp"
#include "redbee/geolocation/target_filter.hpp"
#include "redbee/geometry/camera_intrinsics.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

struct ObservedBox {
  int id = 0;
  ImageBox box;
  bool seen = false;  ///< false: predicted by the tracker, no measurement
};

enum class TargetState : int8_t {
  kMoving = 0,
  kStopped = 1,   ///< slow, or no longer seen to move where it was last seen
  kCoasting = 2,  ///< not seen, predicted
};

struct Target {
  int id = 0;
  TargetState state = TargetState::kMoving;
  Eigen::Vector2d position;             ///< m, east and north in the local frame
  Eigen::Vector2d velocity;             ///< m/s, over ground
  Eigen::Matrix2d position_covariance;  ///< m^2
  Eigen::Matrix2d velocity_covariance;  ///< m^2/s^2
  Eigen::Vector2d size;                 ///< m, across and along the vertical in the image, at its range
  double range_m = 0;                   ///< from the camera, when it was last seen
  double unseen_s = 0;
};

/// Who has stopped, as another process may go on with it.
struct StoppedTarget {
  int id = 0;
  Eigen::Vector2d position;    ///< m
  Eigen::Matrix2d covariance;  ///< m^2
  Eigen::Vector2d size;        ///< m
  double range_m = 0;
  double unseen_s = 0;
};

/// Boxes that could not be placed in a step.
struct RefusedBoxes {
  int above_horizon = 0;  ///< their ray does not meet the ground, or too flat
  int cut_off = 0;        ///< their foot lies outside of the image
};

class Geolocator {
 public:
  /// Throws std::invalid_argument as makeCameraModel() does.
  Geolocator(const CameraIntrinsics& camera, const GeolocationParameters& parameters);

  /// Of the next frames: focal length over that of the camera, and the variance of its logarithm. That lasts
  /// (GeolocationParameters::error_correlation_s) beside the configured focal_sigma.
  void setZoom(double zoom, double variance = 0);
  /// One frame, later than the one before. Without a view all targets are predicted.
  std::vector<Target> step(CameraTime time, const std::optional<GroundView>& view,
                           const std::vector<ObservedBox>& boxes);
  RefusedBoxes refused() const { return refused_; }
  /// As the lens stands, by setZoom().
  const CameraIntrinsics& intrinsics() const { return intrinsics_; }
  const CameraModel& camera() const { return *camera_; }
  /// Those that are no longer seen to move; not who is merely slow, whom the next frame shows again.
  std::vector<StoppedTarget> stopped() const;
  /// Between two steps. Nothing happens to an identity that is known, nor to one that was unseen for too
  /// long.
  void restore(const StoppedTarget& target);
  /// The local coordinates have another origin, or the clock was set: forgets all targets.
  void restart();

 private:
  struct Tracked {
    TargetFilter filter;
    Eigen::Vector2d size;
    double range_m = 0;
    Eigen::Vector2d last_seen;  ///< m
    double unseen_s = 0;
    int gated = 0;            ///< measurements in a row that were not believed
    bool is_reported = true;  ///< the tracker still reports the identity
    bool is_seen = true;      ///< in this frame, measured or not
    bool is_in_view = true;   ///< its place is, as far as it is known
    bool has_stopped = false;
  };
  struct Placed {
    GroundMeasurement measurement;
    Eigen::Vector2d size;
    double range_m = 0;
  };

  /// `predicted`: where the object is expected [m], if it is known.
  std::optional<Placed> place(const ImageBox& box, const GroundView& view,
                              const std::optional<Eigen::Vector2d>& predicted);
  std::optional<GroundPoint> pointOf(const Eigen::Vector2d& foot, const GroundView& view,
                                     const std::optional<Eigen::Vector2d>& predicted) const;
  std::optional<Eigen::Vector2d> project(const Eigen::Vector2d& position, const GroundView& view) const;
  bool isCutOff(const Eigen::Vector2d& foot) const;
  void predict(double seconds);
  void observe(int id, const Placed& placed);
  void begin(int id, const Placed& placed);
  void giveWay(const Placed& newcomer);
  void noteVisibility(const std::optional<GroundView>& view, const std::vector<ObservedBox>& boxes);
  bool isInView(const Eigen::Vector2d& position, const GroundView& view) const;
  void stopUnseen(const std::optional<GroundView>& view);
  void limitTargets();
  static TargetState stateOf(const Tracked& tracked);

  CameraIntrinsics configured_;
  CameraIntrinsics intrinsics_;  ///< as the lens stands
  std::shared_ptr<const CameraModel> camera_;
  GeolocationParameters parameters_;
  double focal_sigma_ =
      parameters_.focal_sigma;  ///< of the next frames, one standard deviation over the focal length
  std::map<int, Tracked> targets_;
  std::optional<CameraTime> last_;
  RefusedBoxes refused_;
};

}  // namespace redbee
