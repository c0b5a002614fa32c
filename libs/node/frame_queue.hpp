// The frames of one source in order of time, although messages arrive late, twice, or among those of another
// time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "redbee/geometry/time.hpp"
#include "redbee/node/frame_rhythm.hpp"

namespace redbee {

enum class FrameArrival {
  kQueued,
  kRepeated,  ///< already received
  kHeld,      ///< late, or of another time: not believed yet
  kResumed,   ///< with those held before it begins a new time, after a pause
  kRestarted  ///< the same, earlier than the frames before: the clock was set back
};

/// A frame is *ordinary* if it follows the last frame taken, by at most a pause, and keeps the rhythm, where
/// there is one; anything else is held. Held frames are believed, and none of them is lost, once five in a
/// row agree and no ordinary frame has come between them for that long, or where the ordinary frames have
/// missed beats meanwhile: the rhythm has changed; or where they have divided five beats in a row evenly: the
/// camera is faster now. A single frame of another time, or those of a second camera, change nothing.
///
/// A gap in the rhythm of the frames may be a frame that was overtaken: the frame behind it is not in order
/// until the window for reordering has passed. Where the rhythm is kept, nothing waits.
template <typename Content>
class FrameQueue {
 public:
  static constexpr size_t kBelieveAfter = 5;  ///< frames
  /// A message may be overtaken by others for this long.
  static constexpr Duration kReordering = std::chrono::milliseconds(100);
  /// Longest pause between ordinary frames, while their period is unknown. Later: kPauseFrames, and at least
  /// kShortPause.
  static constexpr Duration kLongPause = std::chrono::seconds(2);
  static constexpr Duration kShortPause = std::chrono::milliseconds(500);
  static constexpr int kPauseFrames = 8;

  FrameArrival put(CameraTime time, Content content) {
    if (isKnown(time)) return FrameArrival::kRepeated;
    if (isOrdinary(time)) {
      if (hasMissedBeats(time) || isFasterSince(time)) {
        queueHeld();
      } else {
        discardHeld();
      }
      queue_.emplace(time, std::move(content));
      return FrameArrival::kQueued;
    }
    return hold(time, std::move(content));
  }

  bool empty() const { return queue_.empty(); }
  size_t size() const { return queue_.size(); }
  /// Of the next frame. Precondition of this and of the next two: not empty.
  CameraTime frontTime() const { return queue_.begin()->first; }
  /// Whether no earlier frame may still arrive. `now`: the latest message time of the node.
  bool isInOrder(CameraTime now) const {
    const auto period = rhythm_.period();
    if (!last_ || !period) return true;
    const CameraTime before = knownBefore(frontTime());
    const bool has_gap = 2 * (frontTime() - before) > 3 * *period;
    return !has_gap || now >= before + *period + kReordering;
  }
  Content pop() {
    Content content = std::move(queue_.begin()->second);
    advanceTo(frontTime());
    queue_.erase(queue_.begin());
    return content;
  }

  /// Skips frames until at most `most` are left, and returns their times: evenly, each time the one whose
  /// neighbours are closest to each other; never the newest.
  std::vector<CameraTime> limitTo(size_t most) {
    std::vector<CameraTime> skipped;
    while (queue_.size() > std::max<size_t>(most, 1)) skipped.push_back(skip(leastMissed()));
    return skipped;
  }
  /// The same of the oldest frames, until none is older than the newest by more than `longest`; frames that
  /// come more rarely than that are no backlog: the newest two are left.
  std::vector<CameraTime> limitDelayTo(Duration longest) {
    std::vector<CameraTime> skipped;
    while (queue_.size() > 2 && queue_.rbegin()->first - frontTime() > longest) {
      skipped.push_back(skip(queue_.begin()));
    }
    return skipped;
  }

  /// The newest frame taken or queued.
  std::optional<CameraTime> newest() const { return queue_.empty() ? last_ : queue_.rbegin()->first; }
  std::optional<CameraTime> last() const { return last_; }
  /// Held frames that were given up since the last call: late ones, and those of another time.
  struct Discarded {
    int64_t late = 0;
    int64_t of_another_time = 0;
  };
  Discarded takeDiscarded() { return std::exchange(discarded_, {}); }

 private:
  static constexpr size_t kMostHeld = 16;
  static constexpr size_t kMostTaken = 64;
  /// Beats at which a second source was held, after which missed beats are taken for lost frames.
  static constexpr int kKnownSource = 3;
  struct Held {
    CameraTime time;
    Content content;
    bool is_late;  ///< otherwise of another time
  };

  Duration longestPause() const {
    const auto period = rhythm_.period();
    return period ? std::max(kShortPause, kPauseFrames * *period) : kLongPause;
  }
  bool isKnown(CameraTime time) const {
    const bool is_held =
        std::any_of(held_.begin(), held_.end(), [&](const Held& held) { return held.time == time; });
    return is_held || queue_.count(time) > 0 || std::count(taken_.begin(), taken_.end(), time) > 0;
  }
  bool isOrdinary(CameraTime time) const {
    if (last_ && time <= *last_) return false;
    const auto newest = this->newest();
    return !newest || (isNear(time, *newest) && !rhythm_.isBrokenBy(time - *newest));
  }
  bool isNear(CameraTime time, CameraTime newest) const {
    return time - newest <= longestPause() && newest - time <= longestPause();
  }
  bool hasMissedBeats(CameraTime time) const {
    const auto period = rhythm_.period();
    if (held_.empty() || !period || held_.back().is_late || !isNear(held_.back().time, time)) return false;
    return 2 * (time - *newest()) > (held_beats_ < kKnownSource ? 3 : 7) * *period;
  }

  /// A camera that multiplies its rate divides its beats evenly; the phase of a second one is any.
  bool isFasterSince(CameraTime time) {
    even_beats_ = dividesBeat(time) ? even_beats_ + 1 : 0;
    if (even_beats_ < static_cast<int>(kBelieveAfter)) return false;
    even_beats_ = 0;
    rhythm_.clear();
    return true;
  }
  bool dividesBeat(CameraTime time) const {
    const auto newest = this->newest();
    if (held_.empty() || !newest) return false;
    const auto parts = static_cast<int64_t>(held_.size() + 1);
    for (size_t i = 0; i < held_.size(); ++i) {
      const Duration even = (time - *newest) * static_cast<int64_t>(i + 1) / parts;
      if (held_[i].is_late || !FrameRhythm::isSameBeat(held_[i].time - *newest, even, time - *newest))
        return false;
    }
    return true;
  }

  FrameArrival hold(CameraTime time, Content content) {
    const bool agrees = held_.empty() || (time > held_.back().time && time - held_.back().time <= kLongPause);
    if (!agrees || held_.size() >= kMostHeld) discardHeld();
    const bool keeps_rhythm = !rhythm_.isBrokenBy(time - *newest());
    held_.push_back({time, std::move(content), keeps_rhythm && time <= *newest() && isNear(time, *newest())});
    const auto period = rhythm_.period();
    // A faster source sends five between two ordinary frames.
    const bool is_long_enough = !period || 2 * (time - held_.front().time) >= 7 * *period;
    return held_.size() >= kBelieveAfter && is_long_enough ? believe() : FrameArrival::kHeld;
  }
  FrameArrival believe() {
    const bool is_set_back = newest() && held_.front().time <= *newest();
    if (is_set_back) {
      queue_.clear();
      taken_.clear();
      rhythm_.clear();
      last_.reset();
    }
    queueHeld();
    return is_set_back ? FrameArrival::kRestarted : FrameArrival::kResumed;
  }
  void queueHeld() {
    for (Held& held : std::exchange(held_, {})) queue_.emplace(held.time, std::move(held.content));
    held_beats_ = 0;
  }
  void discardHeld() {
    for (const Held& held : held_) ++(held.is_late ? discarded_.late : discarded_.of_another_time);
    held_beats_ = held_.empty() ? 0 : held_beats_ + 1;
    held_.clear();
  }

  /// The latest frame taken or skipped before `time`. Precondition: one was taken.
  CameraTime knownBefore(CameraTime time) const {
    CameraTime latest = *last_;
    for (const CameraTime known : taken_) {
      if (known < time) latest = std::max(latest, known);
    }
    return latest;
  }
  CameraTime skip(typename std::map<CameraTime, Content>::iterator frame) {
    const CameraTime time = frame->first;
    noteTaken(time);
    queue_.erase(frame);
    return time;
  }

  void advanceTo(CameraTime time) {
    if (last_) rhythm_.note(time - knownBefore(time));
    last_ = time;
    noteTaken(time);
  }
  void noteTaken(CameraTime time) {
    taken_.push_back(time);
    if (taken_.size() > kMostTaken) taken_.pop_front();
  }
  auto leastMissed() {
    auto least = queue_.begin();
    Duration smallest = Duration::max();
    for (auto frame = queue_.begin(); std::next(frame) != queue_.end(); ++frame) {
      const CameraTime before =
          frame == queue_.begin() ? last_.value_or(frame->first) : std::prev(frame)->first;
      const Duration gap = std::next(frame)->first - before;
      if (gap < smallest) {
        smallest = gap;
        least = frame;
      }
    }
    return least;
  }

  std::map<CameraTime, Content> queue_;
  std::vector<Held> held_;
  std::optional<CameraTime> last_;  ///< the last frame taken
  std::deque<CameraTime> taken_;    ///< the latest frames taken or skipped
  FrameRhythm rhythm_;              ///< of the frames taken or skipped
  int held_beats_ = 0;              ///< beats in a row between which frames were held
  int even_beats_ = 0;              ///< beats in a row that held frames divided evenly
  Discarded discarded_;
};

}  // namespace redbee
