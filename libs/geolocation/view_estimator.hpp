// From poses, attitudes of the mount and heights to the camera's view of the ground at a frame's time.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "redbee/geolocation/ground_view.hpp"
#include "redbee/geolocation/local_frame.hpp"
#include "redbee/geolocation/parameters.hpp"
#include "redbee/geolocation/vehicle_pose.hpp"

namespace redbee {

/// What is missing for a view.
enum class ViewFault {
  kNone = 0,
  kNoPose,      ///< none has come
  kStalePose,   ///< the nearest is too old, or too new
  kNoPosition,  ///< neither WGS-84 nor the estimator's, or the latter without a fix to relate it to
  kNoMount,     ///< no attitude of the gimbal near the frame
  kNoHeight,    ///< no altimeter, no height above home
};

struct ViewEstimate {
  std::optional<GroundView> view;
  ViewFault fault = ViewFault::kNone;
  double age_s = 0;              ///< of the nearest pose or attitude of the mount, where that is the fault
  double ground_altitude_m = 0;  ///< m above mean sea level, of the ground below the camera, with a fix
  bool has_ground_altitude = false;
};

/// Times may come in any order; a time that was set back forgets what came before.
class ViewEstimator {
 public:
  /// `R_CI`, `p_IC`: of the camera on the body; where a gimbal turns it, at its rest.
  ViewEstimator(const GeolocationParameters& parameters, const Eigen::Matrix3d& R_CI,
                const Eigen::Vector3d& p_IC);

  void note(const VehiclePose& pose);
  void note(const MountAttitude& mount);
  void note(const HeightAboveGround& height);

  /// Attitudes and positions between two messages are interpolated; after the newest, carried on by the last
  /// two attitudes and the velocity for max_pose_age_s at most.
  ViewEstimate at(ImuTime time);
  /// Whether a pose as late as `time` has come.
  bool hasPoseAt(ImuTime time) const { return !poses_.empty() && poses_.back().time >= time; }

  LocalFrame& frame() { return frame_; }
  const LocalFrame& frame() const { return frame_; }

 private:
  std::optional<VehiclePose> poseAt(ImuTime time, double& age_s) const;
  /// Mount to E; std::nullopt where no attitude of it is near.
  std::optional<Eigen::Quaterniond> mountAt(ImuTime time, const Eigen::Quaterniond& R_EB,
                                            double& age_s) const;
  bool addHeight(ImuTime time, const VehiclePose& pose, GroundView& view) const;

  GeolocationParameters parameters_;
  Eigen::Matrix3d R_CI_;
  Eigen::Vector3d p_IC_;
  bool has_gimbal_;
  std::deque<VehiclePose> poses_;
  std::deque<MountAttitude> mounts_;
  std::deque<HeightAboveGround> heights_;
  LocalFrame frame_;
};

}  // namespace redbee
