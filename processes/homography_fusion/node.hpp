// INERTIAL_HOMOGRAPHY and VISUAL_HOMOGRAPHY in; FUSED_HOMOGRAPHY out. IMU is listened to for the passing of
// time only. FILTER_SNAPSHOT is kept, and goes back as WARM_START.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "redbee/configuration/configuration.hpp"
#include "redbee/filter_snapshot_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/fusion/homography_fusion.hpp"
#include "redbee/inertial/calibration_monitor.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/node/message_clock.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/node/stage.hpp"
#include "redbee/visual/front_plane_estimator.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee {

/// One message per frame that either source has reported, in order of time.
class HomographyFusionNode : public Stage {
 public:
  HomographyFusionNode(Bus& bus, const Configuration& configuration);
  void process() override;

 private:
  bool takeInertial(const inertial_homography_t& message);
  bool takeVisual(const visual_homography_t& message);
  void expect(CameraTime time);
  bool isReadyFor(CameraTime time);
  void fuse(CameraTime time);
  fused_homography_t messageOf(const FusedHomography& fused) const;
  /// Compares the two sources' homographies of one pair of frames: whether the calibration fits the flight.
  void validateCalibration(const FusedHomography& fused, const InertialInput& inertial,
                           const VisualInput& visual);
  /// Vision's own homography, rejected by the fusion or not: the inertial filter validates it for itself, or
  /// a diverged filter would never be corrected.
  void addObservation(fused_homography_t& message, const VisualInput& visual) const;
  static void addFrontPlane(fused_homography_t& message, const HomographyEstimate& front);
  /// To an inertial process at its first frame: it may have replaced one that died. It validates the snapshot
  /// for itself.
  void publishWarmStart();
  void restart() override;

  Configuration configuration_;
  CameraIntrinsics camera_;  ///< ideal
  HomographyFusion fusion_;
  FrontPlaneEstimator front_plane_;
  CalibrationMonitor calibration_;
  std::map<CameraTime, WorkTimer> pending_;  ///< frames by time, each since its first message arrived
  MessageSynchronizer<inertial_homography_t> inertial_;
  MessageSynchronizer<visual_homography_t> visual_;
  std::optional<filter_snapshot_t> snapshot_;  ///< the newest of the inertial process
  bool inertial_at_first_frame_ = false;
  MessageClock clock_;
};

}  // namespace redbee
