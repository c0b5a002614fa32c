#include "processes/redbee/detect/collect.hpp"

#include <spdlog/spdlog.h>

#include <chrono>

#include "processes/redbee/detect/collector.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/node/node.hpp"
#include "redbee/node/work_timer.hpp"

namespace redbee {

int64_t runCollect(const CollectOptions& options) {
  const Configuration configuration = loadConfiguration(options.configuration);
  const auto bus = makeLcmBus(options.url);
  ResultCollector collector(*bus, configuration.channels, options.out);
  spdlog::info("collecting: configuration {}, {}", options.configuration.string(), options.url);
  const std::atomic<bool>& stop = stopOnSignals();
  const WorkTimer timer;
  while (!stop) bus->handle(std::chrono::milliseconds(50));
  while (bus->handle(std::chrono::milliseconds(50)) > 0) {
  }
  if (collector.frames() == 0) {
    throw InputError("no frame has arrived on " + configuration.channels.foreground + " (" + options.url +
                     ")");
  }
  collector.writeTables(timer.milliseconds() / 1000, std::nullopt);
  return collector.frames();
}

}  // namespace redbee
