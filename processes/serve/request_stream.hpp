// One connection of a browser, as cpp-httplib reads and writes it: bounded in bytes and in time, which its
// own is not: it reads header lines of any number and length as slowly as they come. Each connection has a
// thread of few, so the bounds are narrower while others wait for one.
#pragma once

#include <httplib.h>

#include <array>
#include <chrono>
#include <functional>
#include <string>
#include <utility>

namespace redbee {

/// No request of the page has a head of a kilobyte, and none has a body.
class RequestStream : public httplib::Stream {
 public:
  static constexpr size_t kMostBytes = 32 * 1024;  ///< of a request, its head and body together
  /// For a request to begin, for the rest of it, and for each part of an answer to be taken; and the same
  /// while others wait.
  struct Patience {
    std::chrono::milliseconds alone, in_crowd;
  };
  static constexpr Patience kIdle{std::chrono::milliseconds(5000), std::chrono::milliseconds(200)};
  static constexpr Patience kReading{std::chrono::milliseconds(5000), std::chrono::milliseconds(500)};
  static constexpr Patience kWriting{std::chrono::milliseconds(5000), std::chrono::milliseconds(1000)};

  /// `socket` is closed by who opened it. `is_crowded`: whether there are more connections than threads.
  RequestStream(int socket, std::function<bool()> is_crowded)
      : socket_(socket), is_crowded_(std::move(is_crowded)) {}

  /// Waits for the next request; false: none has come in time, the other end is gone, or `is_over`.
  bool waitForRequest(const std::function<bool()>& is_over);
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
  /// For an event of poll().
  bool waitFor(short event, Clock::time_point begin, const Patience& patience,
               const std::function<bool()>& is_over) const;

  int socket_;
  std::function<bool()> is_crowded_;
  std::array<char, 4096> buffer_{};
  size_t begin_ = 0;  ///< of what is buffered
  size_t end_ = 0;
  size_t bytes_ = 0;  ///< of this request
  Clock::time_point request_begin_;
  bool is_exhausted_ = false;
};

}  // namespace redbee
