// A stage that processes images, each together with the companion message of the same frame from another
// stage.
#pragma once

#include <algorithm>
#include <deque>
#include <string>
#include <utility>

#include "redbee/image_t.hpp"
#include "redbee/node/stage.hpp"

namespace redbee {

/// Queues at most `max_backlog` images; beyond this the oldest are skipped, so that a slow process does not
/// fall behind.
template <typename Companion>
class ImageStage : public Stage {
 public:
  /// Processes the images in order, up to the first whose companion is pending.
  void process() final {
    while (!images_.empty() && !isPending(companions_, timeOf(images_.front().content), newest_)) {
      const Arrived<image_t> image = std::move(images_.front());
      images_.pop_front();
      workOn(timeOf(image.content), image.since, [&] { work(image.content); });
    }
  }

 protected:
  ImageStage(Bus& bus, const std::string& process, const std::string& configuration_hash,
             const std::string& camera_channel, int max_backlog, MessageSynchronizer<Companion> companions)
      : Stage(bus, process, configuration_hash),
        max_backlog_(static_cast<size_t>(std::max(1, max_backlog))),
        companions_(std::move(companions)) {
    on<image_t>(camera_channel, [this](const image_t& image) { onImage(image); });
  }

  virtual void work(const image_t& image) = 0;
  /// Discards the state; called when the camera's clock was set back.
  virtual void reset() = 0;
  MessageSynchronizer<Companion>& companions() { return companions_; }
  const MessageSynchronizer<Companion>& companions() const { return companions_; }

 private:
  void onImage(const image_t& image) {
    if (!acceptFrame(timeOf(image))) return;
    newest_ = std::max(newest_, timeOf(image));
    images_.push_back({image, {}});
    while (images_.size() > max_backlog_) {
      images_.pop_front();
      health().noteSkipped();
    }
  }
  void restart() final {
    images_.clear();
    newest_ = CameraTime::min();
    companions_.clear();
    reset();
  }

  size_t max_backlog_;
  MessageSynchronizer<Companion> companions_;
  std::deque<Arrived<image_t>> images_;
  CameraTime newest_{};
};

}  // namespace redbee
