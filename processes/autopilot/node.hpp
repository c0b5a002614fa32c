// MAVLink in; IMU, ALTIMETER, POSE, GIMBAL, LENS and AUTOPILOT_CLOCK out.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "processes/link/kept_link.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/mavlink/session.hpp"
#include "redbee/node/node.hpp"

namespace redbee {

/// Publishes each measurement when it arrives, stamped on our clock (libs/node/host_clock.hpp). A device that
/// goes is opened again (BackOff).
class AutopilotNode : public Node {
 public:
  using Clock = KeptLink::Clock;

  /// Throws UserError where autopilot.link is empty or its key cannot be read.
  AutopilotNode(Bus& bus, const Configuration& configuration);
  AutopilotNode(Bus& bus, const Configuration& configuration, std::unique_ptr<Link> link, Clock clock);

  /// One pass: waits up to 20 ms for bytes. Always true: the next pass is due at once.
  bool processNext() override;
  void finish() override {}
  HealthMonitor& health() override { return health_; }

 private:
  void publish(const mavlink::Measurement& measurement);
  void send(int64_t now_ns);
  void noteCounters();
  void describeState(int64_t now_ns);

  Bus& bus_;
  Configuration configuration_;
  HealthMonitor health_;
  KeptLink link_;
  mavlink::Session session_;
  mavlink::SessionCounters reported_;
  int64_t imu_ns_ = 0;   ///< when the last sample arrived
  int64_t pose_ns_ = 0;  ///< and when the last attitude did
};

}  // namespace redbee
