// One connection of a browser, as cpp-httplib reads and writes it: bounded in bytes and in time, which its
// own is not: it reads header lines of any number and length as slowly as they come.
#pragma once

#include <httplib.h>

#include <array>
#include <chrono>
#include <string>

namespace redbee {

/// No request of the page has a head of a kilobyte, and none has a body.
class RequestStream : public httplib::Stream {
 public:
  static constexpr size_t kMostBytes = 32 * 1024;          ///< of a request, its head and body together
  static constexpr std::chrono::seconds kLongest{5};       ///< that reading a request takes
  static constexpr std::chrono::seconds kWriteTimeout{5};  ///< without one byte taken

  /// `socket` is closed by who opened it.
  explicit RequestStream(int socket) : socket_(socket) {}

  /// Waits for a request, at most so long; false: none has come, or the other end is gone.
  bool waitForRequest(std::chrono::milliseconds timeout);
  /// Whether the request came to a bound; nothing more is then read.
  bool isExhausted() const { return is_exhausted_; }

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* to, size_t size) override;
  ssize_t write(const char* from, size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  int socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;
  bool isAlive() const;

  int socket_;
  std::array<char, 4096> buffer_{};
  size_t begin_ = 0;  ///< of what is buffered
  size_t end_ = 0;
  size_t bytes_ = 0;  ///< of this request
  Clock::time_point until_;
  bool is_exhausted_ = false;
};

}  // namespace redbee
