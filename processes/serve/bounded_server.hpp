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

/// Counts the connections that wait for a thread.
class CountingPool : public httplib::ThreadPool {
 public:
  CountingPool(size_t threads, std::atomic<int>& waiting) : ThreadPool(threads), waiting_(waiting) {}

  void enqueue(std::function<void()> work) override {
    ++waiting_;
    ThreadPool::enqueue([this, work = std::move(work)] {
      --waiting_;
      work();
    });
  }

 private:
  std::atomic<int>& waiting_;
};

/// httplib's, but for how it reads and writes.
class BoundedServer : public httplib::Server {
 public:
  /// A viewer has one connection for the events and one or two that fetch.
  static constexpr size_t kThreads = 3 * Live::kMostViewers;
  /// Connections that the kernel keeps until they are accepted. httplib's 5 are full at once where this
  /// process gets no processor for a moment, and then a browser tries again after 1, 3, 7 s.
  static constexpr int kBacklog = 256;

  BoundedServer() {
    new_task_queue = [this] { return new CountingPool(kThreads, waiting_); };
  }
  void widenBacklog() { ::listen(svr_sock_, kBacklog); }

 private:
  bool isStopping() const { return svr_sock_ == INVALID_SOCKET; }

  bool process_and_close_socket(int socket) override {
    RequestStream stream(socket, waiting_);
    bool is_closed = false;
    while (!is_closed && stream.waitForRequest([this] { return isStopping(); })) {
      if (!process_request(stream, false, is_closed, nullptr) || stream.isExhausted()) break;
    }
    shutdown(socket, SHUT_RDWR);
    close(socket);
    return true;
  }

  std::atomic<int> waiting_{0};
};

}  // namespace redbee
