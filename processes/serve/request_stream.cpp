#include "processes/serve/request_stream.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace redbee {
namespace {

bool waitFor(int socket, short events, std::chrono::milliseconds timeout) {
  pollfd entry{socket, events, 0};
  int found = 0;
  do {
    found = poll(&entry, 1, static_cast<int>(std::max<int64_t>(0, timeout.count())));
  } while (found < 0 && errno == EINTR);
  return found > 0 && (entry.revents & POLLNVAL) == 0;
}

}  // namespace

bool RequestStream::waitForRequest(std::chrono::milliseconds timeout) {
  const bool has_come = begin_ < end_ || waitFor(socket_, POLLIN, timeout);
  bytes_ = end_ - begin_;
  until_ = Clock::now() + kLongest;
  return has_come;
}

bool RequestStream::is_readable() const {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until_ - Clock::now());
  return begin_ < end_ || waitFor(socket_, POLLIN, left);
}

/// What the other end sends is of no interest here, but that it is still there.
bool RequestStream::isAlive() const {
  char byte = 0;
  const ssize_t read = recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return read > 0 || (read < 0 && (errno == EAGAIN || errno == EINTR));
}

bool RequestStream::is_writable() const { return waitFor(socket_, POLLOUT, kWriteTimeout) && isAlive(); }

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
