// INERTIAL_HOMOGRAPHY and VISUAL_HOMOGRAPHY in; FUSED_HOMOGRAPHY out. IMU is listened to for the passing of
// time only.
#pragma once

#include <cstdint>
#include <map>

#include "fusion/homography_fusion.hpp"
#include "inertial/calibration_monitor.hpp"
#include "messaging/companion_buffer.hpp"
#include "messaging/configuration.hpp"
#include "messaging/frame_order.hpp"
#include "messaging/message_clock.hpp"
#include "messaging/node.hpp"
#include "processes/work_timer.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/inertial_homography_t.hpp"
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
  void takeVisual(const visual_homography_t& message);
  void expect(int64_t utime);
  bool ready(int64_t utime);
  void fuse(int64_t utime, const WorkTimer& since_arrival);
  fused_homography_t messageOf(const FusedHomography& fused);
  /// What the fusion had: the camera's motion, vision's points and homography, the second plane among them.
  void addSources(fused_homography_t& message, const FusedHomography& fused,
                  const inertial_homography_t* inertial, const visual_homography_t* visual) const;
  void restart();

  Bus& bus_;
  Configuration configuration_;
  HealthMonitor health_;
  HomographyFusion fusion_;
  CalibrationMonitor calibration_;
  FrameOrder order_;
  std::map<int64_t, WorkTimer> pending_;  ///< frames by time, each with its first word's arrival
  CompanionBuffer<inertial_homography_t> inertial_;
  CompanionBuffer<visual_homography_t> visual_;
  MessageClock clock_;
  bool finishing_ = false;
  int32_t sequence_ = 0;
};

}  // namespace redbee
