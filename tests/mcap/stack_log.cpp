// stack_log F.lcm: what a stack publishes, as a log, for tests/integration/speaks_mcap; check_stack.js knows
// its content.
#include <opencv2/core.hpp>

#include "redbee/bus/image.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/files/log.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/image_codec/png.hpp"
#include "redbee/process_health_t.hpp"

namespace redbee {
namespace {

constexpr int kFrames = 10;
constexpr int64_t kStart_us = 1'600'000'000'000'000;

process_health_t healthAt(int k) {
  process_health_t health{};
  health.utime = kStart_us + 1'000'000 * k;
  health.process = "homography-fusion";
  health.pid = 1234;
  health.state = k < 6 ? process_health_t::GOOD : process_health_t::DEGRADED;
  health.message = k < 6 ? "" : "IMU and camera disagree";
  health.latency_p99 = 2.5 * k;
  health.received = 100 * k;
  health.resident = int64_t{3'000'000'000} + k;
  return health;
}

detections_t detectionsAt(int k) {
  detections_t message{};
  message.utime = kStart_us + 1'000'000 * k;
  detection_t box{};
  box.id = 40 + k;
  box.x = 3 * k;
  box.y = 5;
  box.width = 20;
  box.height = 10;
  box.score = 0.5;
  box.seen = k % 2 == 0 ? 1 : 0;
  if (k > 0) message.detections = {box};
  message.n = static_cast<int32_t>(message.detections.size());
  return message;
}

foreground_t foregroundAt(int k) {
  const std::vector<uint8_t> map = encodePng(cv::Mat1b(8, 8, uint8_t{255}));
  foreground_t message{};
  message.utime = kStart_us + 1'000'000 * k;
  message.status = k < 3 ? foreground_t::LEARNING : foreground_t::GOOD;
  message.width = message.height = 8;
  message.mask = message.probability = message.unknown = map;
  message.mask_size = message.probability_size = message.unknown_size = static_cast<int32_t>(map.size());
  return message;
}

}  // namespace
}  // namespace redbee

// A tool of a test: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  using namespace redbee;  // NOLINT: a program of one page
  if (argc != 2) return 2;
  LogWriter log(argv[1]);
  for (int k = 0; k < kFrames; ++k) {
    log.write("PROCESS_HEALTH", healthAt(k));
    log.write("DETECTIONS", detectionsAt(k));
    log.write("FOREGROUND", foregroundAt(k));
  }
  log.close();
  return 0;
}
