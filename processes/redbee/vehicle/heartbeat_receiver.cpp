#include "processes/redbee/vehicle/heartbeat_receiver.hpp"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "redbee/files/input_error.hpp"
#include "redbee/node/unix_address.hpp"

namespace redbee {

HeartbeatReceiver::HeartbeatReceiver(const std::filesystem::path& socket)
    : fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  const auto address = unixAddress(socket.string());
  if (!address) {
    if (fd_ >= 0) close(fd_);
    throw InputError(socket, "is too long for a socket");
  }
  unlink(socket.c_str());
  const int on = 1;
  if (fd_ < 0 || setsockopt(fd_, SOL_SOCKET, SO_PASSCRED, &on, sizeof on) != 0 ||
      bind(fd_, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0 ||
      chmod(socket.c_str(), S_IRUSR | S_IWUSR) != 0) {
    const int error = errno;
    if (fd_ >= 0) close(fd_);
    throw InputError(socket, std::string("cannot be made: ") + std::strerror(error));
  }
}

// The name stays: it may by now be that of the next watch.
HeartbeatReceiver::~HeartbeatReceiver() { close(fd_); }

std::vector<pid_t> HeartbeatReceiver::drain() {
  constexpr int kMost = 1000;  // a sender that does nothing else must not keep the watch from its work
  std::vector<pid_t> senders;
  for (int i = 0; i < kMost; ++i) {
    char text[64];
    iovec part{text, sizeof text};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(ucred))];
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    if (recvmsg(fd_, &message, MSG_CMSG_CLOEXEC) < 0) break;
    const cmsghdr* header = CMSG_FIRSTHDR(&message);
    if (header == nullptr || header->cmsg_level != SOL_SOCKET || header->cmsg_type != SCM_CREDENTIALS)
      continue;
    ucred sender{};
    std::memcpy(&sender, CMSG_DATA(header), sizeof sender);
    if (sender.pid > 0) senders.push_back(sender.pid);
  }
  return senders;
}

}  // namespace redbee
