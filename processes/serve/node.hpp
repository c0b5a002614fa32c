// What the stack publishes, for the ground station in the browser.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "processes/redbee/vehicle/health_board.hpp"
#include "processes/serve/frame_assembly.hpp"
#include "processes/serve/live.hpp"
#include "processes/serve/live_map.hpp"
#include "processes/serve/live_mosaic.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/node/node.hpp"

namespace redbee {

/// Images, masks and homographies, the bulk of what is published, are subscribed to only while somebody
/// looks.
class ServeNode : public Node {
 public:
  ServeNode(Bus& bus, const Configuration& configuration, Live& live, LiveMosaic& mosaic);

  bool processNext() override;
  void finish() override { live_.close(); }
  HealthMonitor& health() override { return health_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// `handler` is called with each plausible message.
  template <typename Message, typename Handler>
  Subscription on(const std::string& channel, Handler handler);
  void followViewers();
  void publishHealth();
  void publishMap();

  Bus& bus_;
  Channels channels_;
  HealthMonitor health_;
  Live& live_;
  LiveMosaic& mosaic_;
  FrameAssembly assembly_;
  LiveMap map_;
  HealthBoard board_;
  Clock::time_point next_board_;
  std::vector<Subscription> always_;
  std::vector<Subscription> while_watched_;
  bool to_release_ = false;  ///< what the viewers needed
};

/// The processes as the page lists them: name, state, tone, figures, remarks.
std::string healthText(const HealthBoard& board, HealthBoard::Time now);

}  // namespace redbee
