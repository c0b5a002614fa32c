// The four nodes under messages that decode but have arbitrary content, in any order, among good ones.
// Input: records of one byte that picks the channel, two bytes of length (big-endian), and so many bytes of
// message behind its hash. A length beyond the end takes what is there.
#include <spdlog/spdlog.h>

#include <algorithm>

#include "processes/in_process_stack.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/filter_snapshot_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/visual_homography_t.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/fuzz/small_vehicle.hpp"

namespace redbee::fuzz {
namespace {

struct Target {
  std::string channel;
  int64_t hash;
};

Target targetOf(const Channels& channels, uint8_t pick) {
  const Target targets[] = {{channels.camera, image_t::getHash()},
                            {channels.imu, ins_t::getHash()},
                            {channels.altimeter, altimeter_t::getHash()},
                            {channels.inertial_homography, inertial_homography_t::getHash()},
                            {channels.visual_homography, visual_homography_t::getHash()},
                            {channels.fused_homography, fused_homography_t::getHash()},
                            {channels.filter_snapshot, filter_snapshot_t::getHash()},
                            {channels.warm_start, filter_snapshot_t::getHash()}};
  return targets[pick % std::size(targets)];
}

void publish(Bus& bus, const Target& target, const uint8_t* data, size_t size) {
  std::vector<uint8_t> message;
  for (int shift = 56; shift >= 0; shift -= 8) {
    message.push_back(static_cast<uint8_t>(static_cast<uint64_t>(target.hash) >> shift));
  }
  message.insert(message.end(), data, data + size);
  bus.publish(target.channel, message);
}

}  // namespace
}  // namespace redbee::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const bool quiet = (spdlog::set_level(spdlog::level::off), true);
  static const Configuration configuration = fuzz::smallVehicle();
  const auto bus = makeLcmBus("memq://");
  InProcessStack stack(*bus, configuration);
  while (quiet && size >= 3) {
    const fuzz::Target target = fuzz::targetOf(configuration.channels, data[0]);
    const size_t length = std::min(size - 3, static_cast<size_t>(data[1]) << 8 | data[2]);
    fuzz::publish(*bus, target, data + 3, length);
    stack.settle();
    data += 3 + length;
    size -= 3 + length;
  }
  stack.finish();
  if (bus->handlerFailures() != 0) __builtin_trap();
  return 0;
}
