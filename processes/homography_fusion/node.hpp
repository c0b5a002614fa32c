// INERTIAL_HOMOGRAPHY and VISUAL_HOMOGRAPHY in; FUSED_HOMOGRAPHY out. IMU messages only advance the message
// clock. The latest FILTER_SNAPSHOT is stored and published as WARM_START.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

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

/// Publishes one message per frame for which either source has published one, in order of time.
class HomographyFusionNode : public Stage {
 public:
  HomographyFusionNode(Bus& bus, const Configuration& configuration);
  bool processNext() override;

 private:
  void onInertial(const inertial_homography_t& message);
  void onVisual(const visual_homography_t& message);
  /// `restored`: what the message repeats of the one before.
  template <typename Message>
  void queue(const std::string& channel, const Message& message, const std::optional<Message>& restored,
             MessageSynchronizer<Message>& messages);
  void expect(const std::string& channel, CameraTime time);
  /// Whether the frame follows the last one fused; without one, what came before is of no use.
  bool isStillToCome(CameraTime frame) const { return pending_.last() && frame > *pending_.last(); }
  CameraTime newestFrame() const { return pending_.newest().value_or(CameraTime::min()); }
  bool isReadyFor(CameraTime time);
  void fuse(CameraTime time);
  fused_homography_t messageOf(const FusedHomography& fused) const;
  /// Updates the calibration monitor with the two sources' homographies of one pair of frames.
  void validateCalibration(const FusedHomography& fused, const InertialInput& inertial,
                           const VisualInput& visual);
  /// Vision has skipped the frame and no IMU bridges it: the chain of steps goes on with the next one.
  void leaveOut(CameraTime time, const visual_homography_t& visual);
  /// Adds vision's tracks and the front plane found in them.
  void addTracked(fused_homography_t& message, const visual_homography_t& visual,
                  const FusedHomography& fused);
  void publishAndForget(CameraTime time, const fused_homography_t& message);
  /// Offers the snapshot to an inertial process at its first frame, which may have been restarted and
  /// validates the snapshot itself.
  void publishWarmStart();
  void restart(CameraTime newest) override;
  CameraTime now() const override { return clock_.now(); }

  Configuration configuration_;
  CameraIntrinsics camera_;  ///< ideal
  HomographyFusion fusion_;
  FrontPlaneEstimator front_plane_;
  CalibrationMonitor calibration_;
  FrameQueue<WorkTimer> pending_;  ///< timers since the first message of the frame
  MessageSynchronizer<inertial_homography_t> inertial_;
  MessageSynchronizer<visual_homography_t> visual_;
  std::optional<filter_snapshot_t> snapshot_;  ///< the latest one received
  bool inertial_at_first_frame_ = false;
  MessageClock clock_;
};

}  // namespace redbee
