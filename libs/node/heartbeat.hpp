// The sign of life of a process, for whoever watches it.
#pragma once

#include <sys/un.h>

#include <chrono>
#include <functional>
#include <string_view>

namespace redbee {

/// Reports that the process makes progress: sends WATCHDOG=1, as sd_notify(3) does, to the Unix socket that
/// an environment variable names; does nothing without it. The kernel tells the receiver who
/// sent it, so that, unlike a message on a channel, nobody can forge it.
class Heartbeat {
 public:
  explicit Heartbeat(const char* variable = "NOTIFY_SOCKET");
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  static constexpr std::chrono::milliseconds kPeriod{100};

  /// Call at least as often as kPeriod; sends once per period, and never waits.
  void beat();
  /// Any other message of sd_notify(3), at once.
  void send(std::string_view message) const;
  /// A message that no later one makes up for: waits until the receiver has taken it, for `patience` at most,
  /// and returns whether it has. systemd leaves out what it reads only after its sender has ended
  /// (sd_notify_barrier(3)). `meanwhile` is called every 20 ms.
  bool deliver(std::string_view message, std::chrono::milliseconds patience,
               const std::function<void()>& meanwhile) const;

 private:
  enum class Sent { kYes, kReceiverIsBehind, kNo };
  /// With a copy of the descriptor `attached`, unless it is negative.
  Sent trySending(std::string_view message, int attached) const;

  int socket_ = -1;
  sockaddr_un address_{};
  std::chrono::steady_clock::time_point next_;
};

}  // namespace redbee
