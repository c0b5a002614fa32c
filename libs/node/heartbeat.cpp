#include "redbee/node/heartbeat.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>

#include "redbee/node/unix_address.hpp"

namespace redbee {

Heartbeat::Heartbeat(const char* variable) {
  const char* path = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe)
  if (path == nullptr || path[0] != '/') return;
  const auto address = unixAddress(path);
  if (!address) return;
  address_ = *address;
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
}

Heartbeat::~Heartbeat() {
  if (socket_ >= 0) close(socket_);
}

void Heartbeat::beat() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kPeriod;
  send("WATCHDOG=1");
}

void Heartbeat::send(std::string_view message) const {
  if (socket_ < 0) return;
  // Nobody may listen just now, or the receiver may be behind: the next one counts.
  static_cast<void>(sendto(socket_, message.data(), message.size(), MSG_NOSIGNAL,
                           reinterpret_cast<const sockaddr*>(&address_), sizeof address_));
}

}  // namespace redbee
