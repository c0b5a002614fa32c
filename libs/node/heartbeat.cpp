#include "redbee/node/heartbeat.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

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
  static_cast<void>(trySending(message, -1));
}

Heartbeat::Sent Heartbeat::trySending(std::string_view message, int attached) const {
  sockaddr_un address = address_;
  iovec text{const_cast<char*>(message.data()), message.size()};  // NOLINT(*-const-cast): sendmsg only reads
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof attached)] = {};
  msghdr header{};
  header.msg_name = &address;
  header.msg_namelen = sizeof address;
  header.msg_iov = &text;
  header.msg_iovlen = 1;
  if (attached >= 0) {
    header.msg_control = control;
    header.msg_controllen = sizeof control;
    cmsghdr* rights = CMSG_FIRSTHDR(&header);
    rights->cmsg_level = SOL_SOCKET;
    rights->cmsg_type = SCM_RIGHTS;
    rights->cmsg_len = CMSG_LEN(sizeof attached);
    std::memcpy(CMSG_DATA(rights), &attached, sizeof attached);
  }
  if (sendmsg(socket_, &header, MSG_NOSIGNAL) >= 0) return Sent::kYes;
  return errno == EAGAIN || errno == EINTR ? Sent::kReceiverIsBehind : Sent::kNo;
}

bool Heartbeat::deliver(std::string_view message, std::chrono::milliseconds patience,
                        const std::function<void()>& meanwhile) const {
  constexpr useconds_t kPause_us = 20'000;
  int ends[2];
  if (socket_ < 0 || pipe2(ends, O_CLOEXEC) != 0) return false;
  const auto end = std::chrono::steady_clock::now() + patience;
  const auto waited = [&] {
    if (std::chrono::steady_clock::now() >= end) return false;
    meanwhile();
    usleep(kPause_us);
    return true;
  };
  const auto send = [&](std::string_view text, int attached) {
    Sent sent = trySending(text, attached);
    while (sent == Sent::kReceiverIsBehind && waited()) sent = trySending(text, attached);
    return sent == Sent::kYes;
  };
  // The receiver closes what comes with a barrier once it has handled all that was sent before.
  bool is_taken = send(message, -1) && send("BARRIER=1", ends[1]);
  close(ends[1]);
  pollfd other_end{ends[0], 0, 0};
  while (is_taken && poll(&other_end, 1, 0) <= 0) is_taken = waited();
  close(ends[0]);
  return is_taken;
}

}  // namespace redbee
