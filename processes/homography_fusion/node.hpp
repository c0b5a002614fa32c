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
#include "redbee/node/frame_order.hpp"
#include "redbee/node/message_clock.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/node/node.hpp"
#include "redbee/node/work_timer.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee {

/// One message per frame that either source has spoken of, in order of time.
class HomographyFusionNode : public Node {
 public:
  HomographyFusionNode(Bus& bus, const Configuration& configuration);
  void process() override;
  void finish() override;
  HealthMonitor& health() override { return health_; }

 private:
  void takeInertial(const inertial_homography_t& message);
  void takeState(const filter_snapshot_t& message) { kept_ = message; }
  void takeVisual(const visual_homography_t& message);
  void expect(int64_t utime);
  bool ready(int64_t utime);
  void fuse(int64_t utime, const WorkTimer& since_arrival);
  fused_homography_t messageOf(const FusedHomography& fused);
  /// What the fusion had: the camera's motion, vision's points and homography, the second plane among them.
  void addSources(fused_homography_t& message, const FusedHomography& fused,
                  const inertial_homography_t* inertial, const visual_homography_t* visual) const;
  /// To an inertial process that begins: it may have taken the place of one that died. Whether it believes
  /// what it is told is its own affair.
  void publishWarmStart();
  void restart();

  Bus& bus_;
  Configuration configuration_;
  HealthMonitor health_;
  CameraIntrinsics camera_;  ///< ideal
  HomographyFusion fusion_;
  CalibrationMonitor calibration_;
  FrameOrder order_;
  std::map<int64_t, WorkTimer> pending_;  ///< frames by time, each with its first word's arrival
  MessageSynchronizer<inertial_homography_t> inertial_;
  MessageSynchronizer<visual_homography_t> visual_;
  std::optional<filter_snapshot_t> kept_;  ///< the newest of the inertial process
  bool inertial_at_first_frame_ = false;
  MessageClock clock_;
  bool finishing_ = false;
  int32_t sequence_ = 0;
};

}  // namespace redbee
