#include "messaging/node.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <csignal>
#include <exception>

namespace redbee {
namespace {

constexpr std::chrono::milliseconds kPatience{50};
constexpr std::chrono::seconds kHealthPeriod{1};

// A signal handler reaches nothing but statics.
std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void requestStop(int) { stop_requested = true; }

/// What escapes one frame's work must not end the flight: the node goes on with the next and says so.
void processGuarded(Node& node) {
  try {
    node.process();
  } catch (const std::exception& error) {
    spdlog::error("a frame could not be worked on: {}", error.what());
    node.health().setState(HealthState::kDegraded, std::string("internal error: ") + error.what());
  }
}

}  // namespace

void runNode(Bus& bus, Node& node, const std::string& health_channel, const std::atomic<bool>& stop) {
  auto next_health = std::chrono::steady_clock::now();
  while (!stop) {
    bus.handle(kPatience);
    processGuarded(node);
    const auto now = std::chrono::steady_clock::now();
    const bool due = now >= next_health;
    if (node.health().takeChange() || due) bus.publish(health_channel, node.health().nextMessage());
    if (due) next_health = now + kHealthPeriod;
  }
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
