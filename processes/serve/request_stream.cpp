#include "processes/serve/request_stream.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace redbee {
namespace {

constexpr std::chrono::milliseconds kGlance{100};  ///< after which the bounds are looked at again

bool never() { return false; }

}  // namespace

bool RequestStream::waitFor(short event, Clock::time_point begin, const Patience& patience,
                            const std::function<bool()>& is_over) const {
  pollfd entry{socket_, event, 0};
  while (!is_over()) {
    const auto bound = is_crowded_() ? patience.in_crowd : patience.alone;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(begin + bound - Clock::now());
    const auto wait = std::clamp(left, std::chrono::milliseconds(0), kGlance);
    const int found = poll(&entry, 1, static_cast<int>(wait.count()));
    if (found > 0) return (entry.revents & POLLNVAL) == 0;
    if ((found < 0 && errno != EINTR) || left <= wait) return false;
  }
  return false;
}

bool RequestStream::waitForRequest(const std::function<bool()>& is_over) {
  const bool has_come = begin_ < end_ || waitFor(POLLIN, Clock::now(), kIdle, is_over);
  bytes_ = end_ - begin_;
  request_begin_ = Clock::now();
  return has_come;
}

bool RequestStream::is_readable() const {
  return begin_ < end_ || waitFor(POLLIN, request_begin_, kReading, never);
}

/// What the other end sends is of no interest here, but that it is still there.
bool RequestStream::isAlive() const {
  char byte = 0;
  const ssize_t read = recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return read > 0 || (read < 0 && (errno == EAGAIN || errno == EINTR));
}

bool RequestStream::is_writable() const {
  return waitFor(POLLOUT, Clock::now(), kWriting, never) && isAlive();
}

ssize_t RequestStream::read(char* to, size_t size) {
  if (begin_ == end_) {
    is_exhausted_ = is_exhausted_ || bytes_ >= kMostBytes || !is_readable();
    if (is_exhausted_) return -1;
    const ssize_t read = recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (read <= 0) return read;
    begin_ = 0;
    end_ = static_cast<size_t>(read);
    bytes_ += end_;
  }
  const size_t taken = std::min(size, end_ - begin_);
  std::copy_n(buffer_.data() + begin_, taken, to);
  begin_ += taken;
  return static_cast<ssize_t>(taken);
}

ssize_t RequestStream::write(const char* from, size_t size) {
  if (!is_writable()) return -1;
  return send(socket_, from, size, MSG_NOSIGNAL);
}

/// Nothing here asks who it is: access is by the token.
void RequestStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

void RequestStream::get_local_ip_and_port(std::string& ip, int& port) const {
  get_remote_ip_and_port(ip, port);
}

}  // namespace redbee
