// A stage that processes images, each together with the companion message of the same frame from another
// stage.
#pragma once

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "redbee/image_t.hpp"
#include "redbee/node/stage.hpp"

namespace redbee {

/// A stage that is slower than the camera falls behind by at most its wait for a companion, in message time,
/// and by kMostQueued images; beyond this it skips frames, evenly.
template <typename Companion>
class ImageStage : public Stage {
 public:
  /// Images that may queue up: half a second of a fast camera.
  static constexpr size_t kMostQueued = 32;

  /// The images in order, up to the first that is not in order or whose companion is pending.
  bool processNext() final {
    noteLeftOutBeforeFront();
    if (images_.empty()) return false;
    if (isLeftOut(images_.frontTime())) {
      images_.pop();
      health().noteSkipped();
      return true;
    }
    const bool is_in_order = isInOrder(images_);
    if (is_in_order) noteMissingBeforeFront();
    if (!is_in_order || isWaiting(images_.frontTime())) {
      waited_until_ = now();
      return false;
    }
    // What came while others were waited for is not old because of this stage.
    const bool is_backlog = images_.frontTime() > waited_until_;
    if (is_backlog && noteSkipped(images_.limitDelayTo(longest_delay_))) return true;
    const Arrived<image_t> image = images_.pop();
    workOn(timeOf(image.content), image.since, [&] { work(image.content); });
    return true;
  }

 protected:
  /// `expected`: whether there are companions; they are waited for until message time has advanced by
  /// `timeout`.
  ImageStage(Bus& bus, const std::string& process, const std::string& configuration_hash,
             const std::string& camera_channel, cv::Size camera_size, Duration timeout, bool expected)
      : Stage(bus, process, configuration_hash), longest_delay_(timeout), companions_(timeout, expected) {
    on<image_t>(camera_channel, [this, camera_channel, camera_size](const image_t& image) {
      if (!isOfCamera(image, camera_size, camera_channel)) return;
      const size_t before = images_.size();
      queueFrame(images_, camera_channel, timeOf(image), Arrived<image_t>{image, {}});
      if (images_.size() > before + 1) waited_until_ = now();  // frames that were held until now
      noteSkipped(images_.limitTo(kMostQueued));
    });
  }

  virtual void work(const image_t& image) = 0;
  /// Whether the frame's messages are pending.
  virtual bool isWaiting(CameraTime frame) { return isPending(companions_, frame); }
  /// Whether the frame need not be processed.
  virtual bool isLeftOut(CameraTime) const { return false; }
  /// Called for each frame that was skipped, in order among those processed.
  virtual void noteLeftOut(CameraTime) {}
  /// Called for each frame before the next one that there is a companion of, but no image: it was lost.
  virtual void noteMissing(CameraTime) {}
  /// Discards the state, and messages of frames after `newest`; called when the camera's clock was set back.
  virtual void reset(CameraTime newest) = 0;
  /// How much older than the newest frame this one is, as far as this stage is the reason.
  Duration backlogOf(CameraTime frame) const { return frame > waited_until_ ? now() - frame : Duration(0); }
  MessageSynchronizer<Companion>& companions() { return companions_; }
  const MessageSynchronizer<Companion>& companions() const { return companions_; }
  /// The newest frame received.
  CameraTime now() const final { return images_.newest().value_or(CameraTime::min()); }

 private:
  /// Whether there are any.
  bool noteSkipped(const std::vector<CameraTime>& frames) {
    health().noteSkipped(static_cast<int64_t>(frames.size()));
    skipped_.insert(frames.begin(), frames.end());
    return !frames.empty();
  }
  void noteLeftOutBeforeFront() {
    while (!skipped_.empty() && (images_.empty() || *skipped_.begin() < images_.frontTime())) {
      noteLeftOut(*skipped_.begin());
      announced_ = std::max(announced_, *skipped_.begin());
      skipped_.erase(skipped_.begin());
    }
  }
  void noteMissingBeforeFront() {
    if (!images_.last()) return;
    announced_ = std::max(announced_, *images_.last());
    companions_.forEach([&](CameraTime time, const Companion&) {
      if (time <= announced_ || time >= images_.frontTime()) return;
      noteMissing(time);
      announced_ = time;
    });
  }

  void restart(CameraTime newest) final {
    companions_.eraseAfter(newest);
    skipped_.clear();
    waited_until_ = announced_ = CameraTime::min();
    reset(newest);
  }

  Duration longest_delay_;
  MessageSynchronizer<Companion> companions_;
  FrameQueue<Arrived<image_t>> images_;
  std::set<CameraTime> skipped_;              ///< of which noteLeftOut() is to be called
  CameraTime announced_ = CameraTime::min();  ///< frames up to this one were processed, left out or missing
  CameraTime waited_until_ = CameraTime::min();  ///< frames up to this one have waited for others
};

}  // namespace redbee
