// Frames lost on the link, by the sequence numbers of each sender.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "redbee/mavlink/frame.hpp"

namespace redbee::mavlink {

/// Sequence numbers have eight bits: of a longer loss, that beyond multiples of 256 is counted. A number that
/// is behind by less than half a turn is a frame that was overtaken, or a sender that was restarted.
class SequenceLoss {
 public:
  void note(const Frame& frame) {
    const auto [sender, is_new] = next_.try_emplace({frame.system, frame.component}, frame.sequence);
    const auto missing = static_cast<uint8_t>(frame.sequence - sender->second);
    if (!is_new && missing < 128) lost_ += missing;
    sender->second = static_cast<uint8_t>(frame.sequence + 1);
  }
  int64_t lost() const { return lost_; }

 private:
  std::map<std::pair<uint8_t, uint8_t>, uint8_t> next_;
  int64_t lost_ = 0;
};

}  // namespace redbee::mavlink
