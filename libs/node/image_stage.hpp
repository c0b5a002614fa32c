// A stage that processes images, each together with the companion message of the same frame from another
// stage.
#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "redbee/image_t.hpp"
#include "redbee/node/stage.hpp"

namespace redbee {

/// Queues at most `max_backlog` images; beyond this some are skipped, evenly, so that a slow process does not
/// fall behind.
template <typename Companion>
class ImageStage : public Stage {
 public:
  /// Processes the images in order, up to the first that is not in order or whose companion is pending.
  void process() final {
    while (!images_.empty() && isInOrder(images_) && !isWaiting(images_.frontTime())) {
      const Arrived<image_t> image = images_.pop();
      workOn(timeOf(image.content), image.since, [&] { work(image.content); });
    }
  }

 protected:
  ImageStage(Bus& bus, const std::string& process, const std::string& configuration_hash,
             const std::string& camera_channel, cv::Size camera_size, int max_backlog,
             MessageSynchronizer<Companion> companions)
      : Stage(bus, process, configuration_hash),
        max_backlog_(static_cast<size_t>(std::max(1, max_backlog))),
        companions_(std::move(companions)) {
    on<image_t>(camera_channel, [this, camera_channel, camera_size](const image_t& image) {
      if (!isOfCamera(image, camera_size, camera_channel)) return;
      queueFrame(images_, camera_channel, timeOf(image), Arrived<image_t>{image, {}});
      health().noteSkipped(images_.limitTo(max_backlog_));
    });
  }

  virtual void work(const image_t& image) = 0;
  /// Whether the frame's messages are pending.
  virtual bool isWaiting(CameraTime frame) { return isPending(companions_, frame); }
  /// Discards the state, and messages of frames after `newest`; called when the camera's clock was set back.
  virtual void reset(CameraTime newest) = 0;
  MessageSynchronizer<Companion>& companions() { return companions_; }
  const MessageSynchronizer<Companion>& companions() const { return companions_; }
  /// The newest frame received.
  CameraTime now() const final { return images_.newest().value_or(CameraTime::min()); }

 private:
  void restart(CameraTime newest) final {
    companions_.eraseAfter(newest);
    reset(newest);
  }

  size_t max_backlog_;
  MessageSynchronizer<Companion> companions_;
  FrameQueue<Arrived<image_t>> images_;
};

}  // namespace redbee
