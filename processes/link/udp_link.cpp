#include "processes/link/udp_link.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "redbee/node/host_clock.hpp"

namespace redbee {
namespace {

constexpr int64_t kPeerSilence_ns = 3'000'000'000;

bool isSame(const sockaddr_in& a, const sockaddr_in& b) {
  return a.sin_addr.s_addr == b.sin_addr.s_addr && a.sin_port == b.sin_port;
}

}  // namespace

UdpLink::UdpLink(const std::string& address, uint16_t port, bool listens, PeerCheck check)
    : name_("UDP " + address + ":" + std::to_string(port)), listens_(listens), check_(std::move(check)) {
  address_.sin_family = AF_INET;
  address_.sin_port = htons(port);
  inet_pton(AF_INET, address.c_str(), &address_.sin_addr);  // linkAddressOf() has checked it
  if (!listens) peer_ = address_;
}

std::string UdpLink::open() {
  FileDescriptor opened(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!opened.isOpen()) return name_ + ": " + std::strerror(errno);
  const auto* address = reinterpret_cast<const sockaddr*>(&address_);
  if (listens_ && bind(opened.get(), address, sizeof address_) != 0)
    return name_ + ": " + std::strerror(errno);
  socket_ = std::move(opened);
  return "";
}

bool UdpLink::isPeer(const sockaddr_in& from, const std::vector<uint8_t>& datagram, int64_t now_ns) {
  if (!listens_) return isSame(from, *peer_);
  const bool is_same = peer_ && isSame(from, *peer_);
  if (peer_ && !is_same && now_ns - heard_ns_ < kPeerSilence_ns) return false;
  // What a peer sends and nobody can read keeps it as little as it would have made it.
  if (check_ && !check_(datagram)) return is_same;
  peer_ = from;
  heard_ns_ = now_ns;
  return true;
}

ReceivedBytes UdpLink::receive(std::chrono::milliseconds timeout) {
  pollfd wait{socket_.get(), POLLIN, 0};
  const int ready = poll(&wait, 1, static_cast<int>(timeout.count()));
  ReceivedBytes received;
  if (ready <= 0) return received;
  std::array<uint8_t, 2048> buffer;  // frames have at most 280 bytes; autopilots send few together
  sockaddr_in from{};
  socklen_t length = sizeof from;
  const ssize_t size =
      recvfrom(socket_.get(), buffer.data(), buffer.size(), 0, reinterpret_cast<sockaddr*>(&from), &length);
  received.host_ns = hostNanoseconds();
  // An error is that of an earlier datagram that nobody took: the peer is not there yet.
  if (size > 0) received.data.assign(buffer.begin(), buffer.begin() + size);
  if (size > 0 && !isPeer(from, received.data, received.host_ns)) received.data.clear();
  return received;
}

bool UdpLink::send(const std::vector<uint8_t>& data) {
  if (!peer_) return true;  // nobody to speak to yet
  const ssize_t size = sendto(socket_.get(), data.data(), data.size(), 0,
                              reinterpret_cast<const sockaddr*>(&*peer_), sizeof *peer_);
  return size == static_cast<ssize_t>(data.size());
}

}  // namespace redbee
