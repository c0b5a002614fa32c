// DETECTIONS and TARGETS in; a MAVLink camera that tracks out.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "processes/link/kept_link.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/mavlink/tracking_camera.hpp"
#include "redbee/node/node.hpp"
#include "redbee/targets_t.hpp"

namespace redbee {

/// Boxes come from the newest DETECTIONS, places from the newest TARGETS. A device that goes is opened again.
class GroundLinkNode : public Node {
 public:
  using Clock = KeptLink::Clock;

  /// Throws UserError where ground_link.link is empty or its key cannot be read.
  GroundLinkNode(Bus& bus, const Configuration& configuration);
  GroundLinkNode(Bus& bus, const Configuration& configuration, std::unique_ptr<Link> link, Clock clock);

  /// One pass: waits up to 20 ms for bytes. Always true: the next pass is due at once.
  bool processNext() override;
  void finish() override {}
  HealthMonitor& health() override { return health_; }

 private:
  void show(const detections_t& message);
  void noteCounters();
  void describeState();

  Configuration configuration_;
  HealthMonitor health_;
  KeptLink link_;
  mavlink::TrackingCamera camera_;
  std::optional<targets_t> targets_;
  int64_t targets_ns_ = 0;  ///< when they came
  int64_t reported_damaged_ = 0;
  int64_t reported_lost_ = 0;
  int64_t reported_unsigned_ = 0;
  std::optional<int> picked_;  ///< as in the log
  std::vector<Subscription> subscriptions_;
};

}  // namespace redbee
