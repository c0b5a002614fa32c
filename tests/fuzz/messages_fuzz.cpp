// The four nodes under messages that decode but have arbitrary content, in any order, among good ones.
// Input: message_records.hpp.
#include <spdlog/spdlog.h>

#include "processes/in_process_stack.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/filter_snapshot_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/visual_homography_t.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/fuzz/message_records.hpp"
#include "tests/fuzz/small_vehicle.hpp"

namespace redbee::fuzz {
namespace {

std::vector<MessageTarget> targetsOf(const Channels& channels) {
  return {{channels.camera, image_t::getHash()},
          {channels.imu, ins_t::getHash()},
          {channels.altimeter, altimeter_t::getHash()},
          {channels.inertial_homography, inertial_homography_t::getHash()},
          {channels.visual_homography, visual_homography_t::getHash()},
          {channels.fused_homography, fused_homography_t::getHash()},
          {channels.filter_snapshot, filter_snapshot_t::getHash()},
          {channels.warm_start, filter_snapshot_t::getHash()}};
}

}  // namespace
}  // namespace redbee::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const bool quiet = (spdlog::set_level(spdlog::level::off), true);
  static const Configuration configuration = fuzz::smallVehicle();
  static const auto targets = fuzz::targetsOf(configuration.channels);
  const auto bus = makeLcmBus("memq://");
  InProcessStack stack(*bus, configuration);
  if (quiet) fuzz::publishRecords(*bus, targets, data, size, [&] { stack.settle(); });
  stack.finish();
  if (bus->handlerFailures() != 0) __builtin_trap();
  return 0;
}
