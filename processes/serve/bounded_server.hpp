// cpp-httplib's server with bounds: in how it reads and writes, and where more connect than it has threads
// for.
#pragma once

#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <utility>

#include "processes/serve/live.hpp"
#include "processes/serve/request_stream.hpp"

namespace redbee {

/// Counts the connections that have a thread or wait for one.
class CountingPool : public httplib::ThreadPool {
 public:
  /// `on_shutdown` is called by the thread that accepts, before it waits for all others to end.
  CountingPool(size_t threads, std::atomic<size_t>& connections, std::function<void()> on_shutdown)
      : ThreadPool(threads), connections_(connections), on_shutdown_(std::move(on_shutdown)) {}

  void enqueue(std::function<void()> work) override {
    ++connections_;
    ThreadPool::enqueue([this, work = std::move(work)] {
      work();
      --connections_;
    });
  }
  void shutdown() override {
    on_shutdown_();
    ThreadPool::shutdown();
  }

 private:
  std::atomic<size_t>& connections_;
  std::function<void()> on_shutdown_;
};

/// httplib's, but for how it reads and writes.
class BoundedServer : public httplib::Server {
 public:
  /// A viewer has one connection for the events and one or two that fetch.
  static constexpr size_t kThreads = 3 * Live::kMostViewers;
  /// Connections that the kernel keeps until they are accepted. httplib's 5 are full at once where this
  /// process gets no processor for a moment, and then a browser tries again after 1, 3, 7 s.
  static constexpr int kBacklog = 256;

  /// `on_failure` is called where accept() has failed, upon which httplib closes its socket and accepts
  /// nothing more.
  explicit BoundedServer(std::function<void()> on_failure) : on_failure_(std::move(on_failure)) {
    new_task_queue = [this] { return new CountingPool(kThreads, connections_, [this] { onAcceptEnd(); }); };
  }
  void widenBacklog() { ::listen(svr_sock_, kBacklog); }

  /// At any time: stop() does nothing before the server listens, and closes the socket again after a failure.
  void end() {
    const int socket = svr_sock_.exchange(INVALID_SOCKET);
    if (socket == INVALID_SOCKET) return;
    shutdown(socket, SHUT_RDWR);
    close(socket);
  }

 private:
  /// Where nobody called end(), accept() has failed. Open connections see by the invalid socket that they are
  /// to end: event streams would otherwise be waited for as long as somebody watches.
  void onAcceptEnd() {
    if (svr_sock_.exchange(INVALID_SOCKET) != INVALID_SOCKET) on_failure_();
  }
  bool isStopping() const { return svr_sock_ == INVALID_SOCKET; }

  bool process_and_close_socket(int socket) override {
    RequestStream stream(socket, [this] { return connections_ > kThreads; });
    bool is_closed = false;
    while (!is_closed && stream.waitForRequest([this] { return isStopping(); })) {
      if (!process_request(stream, false, is_closed, nullptr) || stream.isExhausted()) break;
    }
    shutdown(socket, SHUT_RDWR);
    close(socket);
    return true;
  }

  std::function<void()> on_failure_;
  std::atomic<size_t> connections_{0};
};

}  // namespace redbee
