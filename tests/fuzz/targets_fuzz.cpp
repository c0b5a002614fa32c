// redbee-geolocation under messages that decode but have arbitrary content, in any order, among good ones.
// What it publishes must be plausible. Input: message_records.hpp; the first byte's highest bit stands for a
// gimbal.
#include <spdlog/spdlog.h>

#include "processes/geolocation/node.hpp"
#include "processes/in_process_stack.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/gimbal_t.hpp"
#include "redbee/pose_t.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/fuzz/message_records.hpp"
#include "tests/support/target_flight.hpp"

namespace redbee::fuzz {
namespace {

std::vector<MessageTarget> targetsOf(const Channels& channels) {
  return {{channels.detections, detections_t::getHash()},
          {channels.pose, pose_t::getHash()},
          {channels.altimeter, altimeter_t::getHash()},
          {channels.gimbal, gimbal_t::getHash()},
          {channels.lens, lens_t::getHash()}};
}

struct Vehicle {
  explicit Vehicle(const char* mount) : configuration(test::TargetFlight::configuration()) {
    configuration.geolocation.mount = mount;
    hash = configurationHash(configuration);
  }
  Configuration configuration;
  std::string hash;
};

void run(const Vehicle& vehicle, const uint8_t* data, size_t size) {
  const Configuration& configuration = vehicle.configuration;
  const auto bus = makeLcmBus("memq://");
  const Subscription subscription =
      bus->subscribe<targets_t>(configuration.channels.targets, kListenerQueue, [](const targets_t& message) {
        if (!isPlausible(message)) __builtin_trap();
      });
  Nodes nodes;
  nodes.push_back(std::make_unique<GeolocationNode>(*bus, configuration, vehicle.hash));
  InProcessStack stack(*bus, configuration.channels.health, std::move(nodes));
  publishRecords(*bus, targetsOf(configuration.channels), data, size, [&] { stack.settle(); });
  stack.finish();
  if (bus->handlerFailures() != 0) __builtin_trap();
}

}  // namespace
}  // namespace redbee::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const bool quiet = (spdlog::set_level(spdlog::level::off), true);
  static const fuzz::Vehicle fixed(GeolocationParameters().mount.c_str());
  static const fuzz::Vehicle with_gimbal("gimbal");
  if (quiet && size > 0) fuzz::run((data[0] & 0x80) == 0 ? fixed : with_gimbal, data, size);
  return 0;
}
