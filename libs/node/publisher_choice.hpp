// Chooses between several publishers of one channel.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "redbee/geometry/time.hpp"
#include "redbee/node/frame_time.hpp"

namespace redbee {

/// The first publisher (`message.publisher`) is listened to, and any other is ignored until the first has
/// gone: until it has been silent for kSilence, or for kInARow messages of one other. Nothing of a restarted
/// process is lost: its messages are held until it is believed.
template <typename Message>
class PublisherChoice {
 public:
  static constexpr size_t kInARow = 5;
  static constexpr Duration kSilence = std::chrono::milliseconds(250);

  /// The messages to take, in order: this one, none, or this one after those that were held. `now`: the
  /// latest message time of the node.
  std::vector<Message> admit(const Message& message, CameraTime now) {
    if (!current_ || message.publisher == *current_) {
      current_ = message.publisher;
      last_ = std::max(now, timeOf(message));
      ignored_ += static_cast<int64_t>(held_.size());
      held_.clear();
      return {message};
    }
    if (!held_.empty() && held_.back().publisher != message.publisher) {
      ignored_ += static_cast<int64_t>(held_.size());
      held_.clear();
    }
    held_.push_back(message);
    if (held_.size() < kInARow && now < last_ + kSilence) return {};
    current_ = message.publisher;
    last_ = std::max(now, timeOf(message));
    has_changed_ = true;
    return std::exchange(held_, {});
  }

  /// Messages of other publishers given up since the last call.
  int64_t takeIgnored() { return std::exchange(ignored_, 0); }
  /// Whether the publisher has changed since the last call.
  bool takeChange() { return std::exchange(has_changed_, false); }

 private:
  std::optional<int64_t> current_;
  CameraTime last_{};  ///< when the current one last spoke
  std::vector<Message> held_;
  int64_t ignored_ = 0;
  bool has_changed_ = false;
};

}  // namespace redbee
