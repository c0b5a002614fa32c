#include "processes/redbee/announce.hpp"

#include "flight/input_error.hpp"
#include "messaging/bus.hpp"
#include "messaging/health.hpp"

namespace redbee {

void runAnnounce(const AnnounceOptions& options) {
  const auto state = healthStateOf(options.state);
  if (!state) throw InputError("--state " + options.state + ": no such state");
  HealthMonitor health(options.process, "");
  health.setState(*state, options.message);
  process_health_t message = health.nextMessage();
  message.pid = options.process_id;
  message.resident = 0;
  makeLcmBus(options.url)->publish(options.channel, message);
}

}  // namespace redbee
