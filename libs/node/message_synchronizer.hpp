// Waits for the companion message of a frame, with a timeout in message time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "redbee/geometry/time.hpp"

namespace redbee {

/// Stores the messages of one channel by frame time; of several messages about a frame, the first. A
/// companion is pending until message time has advanced by `timeout`, or a later message of the channel has
/// overtaken it by more than messages are ever reordered: then it was lost. A publisher that timed out for
/// kMissedInARow frames is considered dead until its next message and is not waited for. So the results
/// depend on the messages only, and a dead publisher costs the delay of one timeout. After fewer, where
/// stages wait for each other, a lost message would have all of them go on without the others at once.
template <typename Message>
class MessageSynchronizer {
 public:
  enum class Status { kReady, kPending, kTimedOut };
  /// A message may be overtaken by later ones for this long.
  static constexpr Duration kReordering = std::chrono::milliseconds(100);
  static constexpr int kMissedInARow = 3;
  /// A message may be ahead of the newest frame by this much, where images are lost; what arrives further
  /// ahead overtakes nothing.
  static constexpr Duration kMostAhead = std::chrono::milliseconds(500);

  /// `expected` false: companions never become pending (a vehicle without this source).
  MessageSynchronizer(Duration timeout, bool expected, size_t capacity = 64)
      : timeout_(timeout), expected_(expected), alive_(expected), capacity_(capacity) {}

  /// `newest`: the newest frame, or CameraTime::min().
  void put(CameraTime time, Message message, CameraTime newest) {
    const bool is_far_ahead = time > newest + kMostAhead;
    if (!is_far_ahead) {
      alive_ = expected_;
      missed_in_a_row_ = 0;
    }
    const auto known = messages_.find(time);
    if (known != messages_.end() && known->second.kind == Kind::kReceived) return;
    store(time, {std::move(message), newest, is_far_ahead ? Kind::kFarAhead : Kind::kReceived});
  }
  /// What a later message says about the frame at `time`: found in place of the message, should that be lost.
  void putRestored(CameraTime time, Message message) {
    if (messages_.count(time) == 0) store(time, {std::move(message), time, Kind::kRestored});
  }

  /// `newest`: the latest message time that the node has seen on any channel.
  Status status(CameraTime time, CameraTime newest) {
    const auto known = messages_.find(time);
    if (known != messages_.end() && known->second.kind != Kind::kRestored) return Status::kReady;
    if (!alive_) return Status::kTimedOut;
    const bool overtaken = isOvertaken(time, newest);
    if (!overtaken && newest - time <= timeout_) return Status::kPending;
    if (last_timed_out_ != time) {
      ++timed_out_;
      if (!overtaken && ++missed_in_a_row_ >= kMissedInARow) alive_ = false;
    }
    last_timed_out_ = time;
    return Status::kTimedOut;
  }

  /// Whether the publisher is waited for.
  bool isAlive() const { return alive_; }

  const Message* find(CameraTime time) const {
    const auto it = messages_.find(time);
    return it == messages_.end() ? nullptr : &it->second.message;
  }
  /// Calls `visit(time, message)` for each message, in order of time.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (const auto& [time, received] : messages_) {
      if (received.kind != Kind::kFarAhead) visit(time, received.message);
    }
  }
  size_t size() const { return messages_.size(); }
  void eraseThrough(CameraTime time) { messages_.erase(messages_.begin(), messages_.upper_bound(time)); }
  void eraseBefore(CameraTime time) { messages_.erase(messages_.begin(), messages_.lower_bound(time)); }
  void eraseAfter(CameraTime time) { messages_.erase(messages_.upper_bound(time), messages_.end()); }
  /// Companions that timed out.
  int64_t timedOut() const { return timed_out_; }

 private:
  enum class Kind { kReceived, kFarAhead, kRestored };
  struct Received {
    Message message;
    CameraTime newest;  ///< the newest frame when it arrived
    Kind kind;
  };

  void store(CameraTime time, Received received) {
    messages_.insert_or_assign(time, std::move(received));
    if (messages_.size() <= capacity_) return;
    const auto last = std::prev(messages_.end());
    messages_.erase(last->second.kind == Kind::kFarAhead ? last : messages_.begin());
  }

  bool isOvertaken(CameraTime time, CameraTime newest) const {
    return std::any_of(messages_.upper_bound(time), messages_.end(), [&](const auto& later) {
      return later.second.kind == Kind::kReceived &&
             newest - std::max(later.second.newest, time) >= kReordering;
    });
  }

  Duration timeout_;
  bool expected_;
  bool alive_;
  size_t capacity_;
  int64_t timed_out_ = 0;
  int missed_in_a_row_ = 0;
  std::optional<CameraTime> last_timed_out_;  ///< the frame counted last: it may be asked for again
  std::map<CameraTime, Received> messages_;
};

}  // namespace redbee
