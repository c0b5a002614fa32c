#include "redbee/node/node.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <csignal>
#include <exception>
#include <new>
#include <opencv2/core.hpp>

#include "redbee/node/heartbeat.hpp"

namespace redbee {
namespace {

constexpr std::chrono::milliseconds kPollTimeout{50};
constexpr std::chrono::seconds kHealthPeriod{1};

// A signal handler can only access static objects.
std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void requestStop(int) { stop_requested = true; }

/// An exception while one frame is processed must not end the flight: the node reports it and continues with
/// the next frame. Returns whether there may be more to do. A process that is out of memory would keep
/// failing: it ends, and supervisor restarts it.
template <typename Work>
bool guarded(Node& node, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    const auto* from_opencv = dynamic_cast<const cv::Exception*>(&error);
    if (from_opencv != nullptr && from_opencv->code == cv::Error::StsNoMem) throw std::bad_alloc();
    spdlog::error("a frame could not be processed: {}", error.what());
    node.health().setState(HealthState::kDegraded, std::string("internal error: ") + error.what());
    return true;  // the frames behind it
  }
}

/// Time since the last message of the input that drives a node.
class InputSilenceTimer {
 public:
  using Clock = std::chrono::steady_clock;

  double seconds(int64_t inputs, Clock::time_point now) {
    if (inputs != inputs_) last_ = now;
    inputs_ = inputs;
    return std::chrono::duration<double>(now - last_).count();
  }

 private:
  int64_t inputs_ = 0;
  Clock::time_point last_ = Clock::now();
};

}  // namespace

void runNode(Bus& bus, Node& node, const std::string& health_channel, const std::atomic<bool>& stop) {
  auto next_health = std::chrono::steady_clock::now();
  InputSilenceTimer silence;
  int64_t failures = 0;
  Heartbeat heartbeat;
  node.health().onProgress([&] { heartbeat.beat(); });
  bool may_have_more = false;
  while (!stop) {
    bus.handle(may_have_more ? std::chrono::milliseconds(0) : kPollTimeout);
    heartbeat.beat();
    node.health().noteDamaged(bus.handlerFailures() - failures);
    failures = bus.handlerFailures();
    may_have_more = guarded(node, [&] { return node.processNext(); });
    const auto now = std::chrono::steady_clock::now();
    node.health().setInputSilence(silence.seconds(node.health().inputs(), now));
    const bool due = now >= next_health;
    if (node.health().consumeChange() || due) bus.publish(health_channel, node.health().nextMessage());
    if (due) next_health = now + kHealthPeriod;
  }
  guarded(node, [&] {
    node.finish();
    return false;
  });
  node.health().onProgress({});
  node.health().setState(HealthState::kStopping);
  bus.publish(health_channel, node.health().nextMessage());
}

const std::atomic<bool>& stopOnSignals() {
  struct sigaction action {};
  action.sa_handler = requestStop;
  sigemptyset(&action.sa_mask);
  // Without SA_RESTART a signal ends the wait for messages at once.
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return stop_requested;
}

}  // namespace redbee
