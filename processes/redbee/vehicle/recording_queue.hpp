// The queue between network and disk: a temporary stall of the disk loses no message, and memory is bounded.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "redbee/files/split_log.hpp"

namespace redbee {

/// Writes in its own thread, in order of arrival. push(), failure() and close() must be called by one other
/// thread.
class RecordingQueue {
 public:
  using Write = std::function<void(const ReceivedMessage&)>;

  /// `limit_bytes`: of queued messages. An exception from `write` stops the writing.
  RecordingQueue(Write write, int64_t limit_bytes);
  ~RecordingQueue();
  RecordingQueue(const RecordingQueue&) = delete;
  RecordingQueue& operator=(const RecordingQueue&) = delete;

  /// Returns false if the queue is full or writing has stopped; the message is then lost.
  bool push(ReceivedMessage message);
  /// The error that stopped the writing; empty if there is none.
  std::string failure() const;
  /// Returns when all queued messages are written.
  void close();

 private:
  void run();
  void writeAll();

  Write write_;
  int64_t limit_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ReceivedMessage> waiting_;
  int64_t waiting_bytes_ = 0;
  bool closing_ = false;
  std::string failure_;
  std::thread thread_;
};

}  // namespace redbee
