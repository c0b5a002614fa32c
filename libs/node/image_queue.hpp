// Images that wait for their turn, and for the message that belongs to each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>

#include "redbee/image_t.hpp"
#include "redbee/node/frame_intake.hpp"
#include "redbee/node/frame_order.hpp"
#include "redbee/node/health.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/node/work_timer.hpp"

namespace redbee {

/// Keeps at most `max_backlog` images: beyond it the oldest are skipped, so that a slow process stays with
/// the present.
class ImageQueue {
 public:
  explicit ImageQueue(int max_backlog) : max_backlog_(static_cast<size_t>(std::max(1, max_backlog))) {}

  /// `restart` is called first where the camera's clock was set back; what waited is then gone.
  template <typename Restart>
  void take(const image_t& image, HealthMonitor& health, const Restart& restart) {
    const auto restart_all = [&] {
      pending_.clear();
      newest_utime_ = image.utime;
      restart();
    };
    if (!acceptFrame(order_, health, image.utime, restart_all)) return;
    newest_utime_ = std::max(newest_utime_, image.utime);
    pending_.push_back({image, {}});
    while (pending_.size() > max_backlog_) {
      pending_.pop_front();
      health.noteSkipped();
    }
  }

  /// Works the images off in order, up to the first whose companion is still worth waiting for.
  template <typename Message, typename Work>
  void workOff(MessageSynchronizer<Message>& companions, HealthMonitor& health, const Work& work) {
    while (!pending_.empty()) {
      const int64_t before = companions.timedOut();
      const auto answer = companions.status(pending_.front().content.utime, newest_utime_);
      health.noteLate(companions.timedOut() - before);
      if (answer == MessageSynchronizer<Message>::Status::kPending) return;
      workOnFirst(work);
    }
  }
  /// Works off all there are.
  template <typename Work>
  void workOffAll(const Work& work) {
    while (!pending_.empty()) workOnFirst(work);
  }

 private:
  template <typename Work>
  void workOnFirst(const Work& work) {
    const Arrived<image_t> image = std::move(pending_.front());
    pending_.pop_front();
    work(image);
  }

  size_t max_backlog_;
  FrameOrder order_;
  std::deque<Arrived<image_t>> pending_;
  int64_t newest_utime_ = 0;
};

}  // namespace redbee
