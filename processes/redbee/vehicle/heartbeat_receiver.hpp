// The other end of Heartbeat.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <vector>

namespace redbee {

class HeartbeatReceiver {
 public:
  /// Replaces an earlier socket of this name. Throws InputError if it cannot be made.
  explicit HeartbeatReceiver(const std::filesystem::path& socket);
  ~HeartbeatReceiver();
  HeartbeatReceiver(const HeartbeatReceiver&) = delete;
  HeartbeatReceiver& operator=(const HeartbeatReceiver&) = delete;

  /// The senders of all heartbeats since the last call, as the kernel states them.
  std::vector<pid_t> drain();

 private:
  int fd_ = -1;
};

}  // namespace redbee
