// Waits for the companion message of a frame, with a timeout in message time.
#pragma once

#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

#include "redbee/geometry/time.hpp"
#include "redbee/node/frame_order.hpp"

namespace redbee {

/// Stores the messages of one channel by frame time. A companion is pending until a later message of the
/// channel shows that it was lost, or message time has advanced by `timeout`. A publisher that timed out is
/// considered dead until its next message and is not waited for. So the results depend on the messages only,
/// and a dead publisher causes only one timeout.
template <typename Message>
class MessageSynchronizer {
 public:
  enum class Status { kReady, kPending, kTimedOut };

  /// `expected` false: companions never become pending (a vehicle without this source).
  MessageSynchronizer(Duration timeout, bool expected, size_t capacity = 64)
      : timeout_(timeout), expected_(expected), alive_(expected), capacity_(capacity) {}

  /// Erases stored messages that are later by more than kSetBack: either the clock was set back or they were
  /// damaged; they would make every later companion seem lost.
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
    if (!overtaken && newest - time <= timeout_) return Status::kPending;
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
  Duration timeout_;
  bool expected_;
  bool alive_;
  size_t capacity_;
  int64_t timed_out_ = 0;
  std::map<CameraTime, Message> messages_;
};

}  // namespace redbee
