// Waiting for the message that belongs to a frame, but not for ever, and without looking at a clock.
#pragma once

#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "redbee/node/frame_order.hpp"

namespace redbee {

/// Messages of one channel by frame time. A frame's companion is waited for while its publisher is considered
/// alive: until a later message of the channel shows that it was lost, or message time has moved on by
/// `patience_us`. A publisher that timed out is considered dead until its next message. So the result depends
/// on the messages alone while none is lost, and a dead publisher costs one wait.
template <typename Message>
class MessageSynchronizer {
 public:
  enum class Status { kReady, kPending, kTimedOut };

  /// `expected` false: never waited for (a vehicle without this source).
  MessageSynchronizer(int64_t patience_us, bool expected, size_t capacity = 64)
      : patience_us_(patience_us), expected_(expected), alive_(expected), capacity_(capacity) {}

  /// Messages that are later by more than kSetBack are forgotten: either time was set back, or they were
  /// damaged, and would make every companion look overtaken from then on.
  void put(int64_t utime, Message message) {
    alive_ = expected_;
    const int64_t horizon = std::numeric_limits<int64_t>::max() - FrameOrder::kSetBack;
    if (utime < horizon)
      messages_.erase(messages_.upper_bound(utime + FrameOrder::kSetBack), messages_.end());
    messages_[utime] = std::move(message);
    if (messages_.size() > capacity_) messages_.erase(messages_.begin());
  }

  /// `newest_utime`: the latest message time that the node has seen on any channel.
  Status status(int64_t utime, int64_t newest_utime) {
    if (messages_.count(utime) > 0) return Status::kReady;
    if (!alive_) return Status::kTimedOut;
    const bool overtaken = messages_.upper_bound(utime) != messages_.end();
    if (!overtaken && newest_utime - utime <= patience_us_) return Status::kPending;
    if (!overtaken) alive_ = false;
    ++timed_out_;
    return Status::kTimedOut;
  }

  const Message* find(int64_t utime) const {
    const auto it = messages_.find(utime);
    return it == messages_.end() ? nullptr : &it->second;
  }
  const std::map<int64_t, Message>& messages() const { return messages_; }
  void eraseThrough(int64_t utime) { messages_.erase(messages_.begin(), messages_.upper_bound(utime)); }
  void clear() { messages_.clear(); }
  /// Companions that timed out.
  int64_t timedOut() const { return timed_out_; }

 private:
  int64_t patience_us_;
  bool expected_;
  bool alive_;
  size_t capacity_;
  int64_t timed_out_ = 0;
  std::map<int64_t, Message> messages_;
};

}  // namespace redbee
