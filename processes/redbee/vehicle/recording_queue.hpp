// The queue between the network and the disk: a disk that stalls for a while costs no message, and one that
// stalls for good costs only limited memory.
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

/// Writes in a thread of its own, in the order of arrival. push(), failure() and close() are one other
/// thread's.
class RecordingQueue {
 public:
  using Write = std::function<void(const ReceivedMessage&)>;

  /// `limit_bytes`: of waiting messages. An exception from `write` ends the writing.
  RecordingQueue(Write write, int64_t limit_bytes);
  ~RecordingQueue();
  RecordingQueue(const RecordingQueue&) = delete;
  RecordingQueue& operator=(const RecordingQueue&) = delete;

  /// False if there is no room, or the writing has ended: the message is lost.
  bool push(ReceivedMessage message);
  /// The reason why the writing ended; empty while all is well.
  std::string failure() const;
  /// Returns when all that was pushed is written.
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
