// CAMERA (its times), IMU, ALTIMETER, GIMBAL, LENS, FUSED_HOMOGRAPHY and WARM_START in; INERTIAL_HOMOGRAPHY
// and FILTER_SNAPSHOT out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "redbee/altimeter_t.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/earlier_step_t.hpp"
#include "redbee/filter_snapshot_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/gimbal_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/inertial/inertial_filter.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/lens_t.hpp"
#include "redbee/node/message_clock.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/node/stage.hpp"

namespace redbee {

/// Publishes one message per frame, as soon as the IMU's samples (and GIMBAL and LENS, where these turn and
/// zoom the camera) reach its exposure and the fused homography of the previous frame has arrived. While
/// vision agrees with the filter, a filter snapshot is published as well; at its first frame the filter is
/// warm-started from the snapshot that the fusion has stored (processes/homography_fusion).
class ImuIntegrationNode : public Stage {
 public:
  ImuIntegrationNode(Bus& bus, const Configuration& configuration);
  bool processNext() override;

 private:
  void onFrame(const image_t& message);
  bool onImu(const ins_t& message);
  bool onGimbal(const gimbal_t& message);
  bool onLens(const lens_t& message);
  void onFused(const fused_homography_t& message);
  bool isReadyFor(CameraTime frame);
  /// Whether what `alive` is about still has to be waited for; clears it where it timed out.
  bool isAwaited(CameraTime frame, bool is_there, bool& alive) const;
  /// Called when a frame arrives.
  void noteClockOffset(CameraTime frame);
  std::string reasonOf(InertialStatus status) const;
  void updateState(const InertialHomography& result);
  void warmStart();
  void applyFeedback();
  void noteCorrection(const HomographyObservation& observation, const CorrectionReport& report);
  void publishSnapshot();
  void integrate(CameraTime frame);
  void restart(CameraTime newest) override;
  CameraTime now() const override { return clock_.now(); }

  Configuration configuration_;
  std::string configuration_hash_;
  Camera camera_;
  InertialFilter filter_;
  FrameQueue<WorkTimer> pending_;  ///< timers since the frame's arrival
  MessageSynchronizer<fused_homography_t> feedback_;
  MessageClock clock_;
  std::optional<CameraTime> last_frame_;
  std::optional<filter_snapshot_t> warm_start_;  ///< the latest one received
  CorrectionReport feedback_report_;             ///< the last one since the frame before
  Duration agreed_{0};                           ///< measured by the corrections since one was rejected
  std::optional<CameraTime> agreed_until_;       ///< the last of them
  bool imu_alive_ = true;
  bool gimbal_alive_ = true;
  bool lens_alive_ = true;
  std::optional<ImuTime> last_sample_;    ///< since the newest frame arrived
  std::optional<double> clock_offset_s_;  ///< of that frame's exposure to the newest sample then
  earlier_step_t earlier_{};              ///< of the message before
};

}  // namespace redbee
