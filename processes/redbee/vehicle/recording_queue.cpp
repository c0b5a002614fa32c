#include "processes/redbee/vehicle/recording_queue.hpp"

#include <exception>
#include <utility>

namespace redbee {

RecordingQueue::RecordingQueue(Write write, int64_t limit_bytes)
    : write_(std::move(write)), limit_bytes_(limit_bytes), thread_([this] { run(); }) {}

RecordingQueue::~RecordingQueue() { close(); }

bool RecordingQueue::push(ReceivedMessage message) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!failure_.empty() || waiting_bytes_ + message.bytes() > limit_bytes_) return false;
    waiting_bytes_ += message.bytes();
    waiting_.push_back(std::move(message));
  }
  changed_.notify_one();
  return true;
}

std::string RecordingQueue::failure() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

void RecordingQueue::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closing_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void RecordingQueue::run() {
  try {
    writeAll();
  } catch (const std::exception& error) {
    const std::lock_guard<std::mutex> lock(mutex_);
    failure_ = error.what();
    waiting_.clear();
  }
}

void RecordingQueue::writeAll() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const ReceivedMessage message = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    write_(message);
    lock.lock();
    waiting_bytes_ -= message.bytes();
  }
}

}  // namespace redbee
