// Waiting for the message that belongs to a frame, but not for ever, and without looking at a clock.
#pragma once

#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

#include "redbee/geometry/time.hpp"
#include "redbee/node/frame_order.hpp"

namespace redbee {

/// Messages of one channel by frame time. A frame's companion is waited for while its publisher is considered
/// alive: until a later message of the channel shows that it was lost, or message time has moved on by
/// `patience`. A publisher that timed out is considered dead until its next message. So the result depends
/// on the messages alone while none is lost, and a dead publisher costs one wait.
template <typename Message>
class MessageSynchronizer {
 public:
  enum class Status { kReady, kPending, kTimedOut };

  /// `expected` false: never waited for (a vehicle without this source).
  MessageSynchronizer(Duration patience, bool expected, size_t capacity = 64)
      : patience_(patience), expected_(expected), alive_(expected), capacity_(capacity) {}

  /// Messages that are later by more than kSetBack are forgotten: either time was set back, or they were
  /// damaged, and would make every companion look overtaken from then on.
  void put(CameraTime time, Message message) {
    alive_ = expected_;
    const CameraTime horizon = CameraTime::max() - FrameOrder::kSetBack;
    if (time < horizon) messages_.erase(messages_.upper_bound(time + FrameOrder::kSetBack), messages_.end());
    messages_[time] = std::move(message);
    if (messages_.size() > capacity_) messages_.erase(messages_.begin());
  }

  /// `newest`: the latest message time that the node has seen on any channel.
  Status status(CameraTime time, CameraTime newest) {
    if (messages_.count(time) > 0) return Status::kReady;
    if (!alive_) return Status::kTimedOut;
    const bool overtaken = messages_.upper_bound(time) != messages_.end();
    if (!overtaken && newest - time <= patience_) return Status::kPending;
    if (!overtaken) alive_ = false;
    ++timed_out_;
    return Status::kTimedOut;
  }

  const Message* find(CameraTime time) const {
    const auto it = messages_.find(time);
    return it == messages_.end() ? nullptr : &it->second;
  }
  const std::map<CameraTime, Message>& messages() const { return messages_; }
  void eraseThrough(CameraTime time) { messages_.erase(messages_.begin(), messages_.upper_bound(time)); }
  void clear() { messages_.clear(); }
  /// Companions that timed out.
  int64_t timedOut() const { return timed_out_; }

 private:
  Duration patience_;
  bool expected_;
  bool alive_;
  size_t capacity_;
  int64_t timed_out_ = 0;
  std::map<CameraTime, Message> messages_;
};

}  // namespace redbee
