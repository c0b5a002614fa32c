// CAMERA (its times), IMU, ALTIMETER, FUSED_HOMOGRAPHY and WARM_START in; INERTIAL_HOMOGRAPHY and
// FILTER_SNAPSHOT out.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "redbee/altimeter_t.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/filter_snapshot_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/inertial/inertial_filter.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/node/frame_order.hpp"
#include "redbee/node/message_clock.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/node/node.hpp"
#include "redbee/node/work_timer.hpp"

namespace redbee {

/// One message per frame, as soon as the IMU's samples reach its exposure and the fusion has answered for the
/// frame before. While vision agrees with it, it also says what it has learned; when it begins, it goes on
/// from what a neighbour has kept of that (processes/homography_fusion).
class ImuIntegrationNode : public Node {
 public:
  ImuIntegrationNode(Bus& bus, const Configuration& configuration);
  void process() override;
  void finish() override;
  HealthMonitor& health() override { return health_; }

 private:
  struct Frame {
    int64_t utime;
    WorkTimer since_arrival;
  };

  void takeFrame(const image_t& message);
  void takeImu(const ins_t& message);
  void takeAltitude(const altimeter_t& message);
  void takeFused(const fused_homography_t& message);
  void takeWarmStart(const filter_snapshot_t& message) { kept_ = message; }
  bool readyFor(int64_t frame_utime);
  void warmStart();
  void applyFeedback();
  void publishSnapshot();
  void integrate(const Frame& frame);
  void restart();

  Bus& bus_;
  Configuration configuration_;
  std::string configuration_hash_;
  HealthMonitor health_;
  Camera camera_;
  InertialFilter filter_;
  FrameOrder order_;
  std::deque<Frame> pending_;
  MessageSynchronizer<fused_homography_t> feedback_;
  MessageClock clock_;
  std::optional<int64_t> last_frame_utime_;
  std::optional<filter_snapshot_t> kept_;
  CorrectionReport feedback_report_;  ///< of the last frame
  int agreed_in_a_row_ = 0;           ///< frames that vision's correction was accepted at
  bool imu_alive_ = true;
  bool finishing_ = false;
  int32_t sequence_ = 0;
};

}  // namespace redbee
