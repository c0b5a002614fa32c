#include "processes/serve/live.hpp"

#include <utility>

namespace redbee {

const std::string& SharedFrame::bundle() {
  std::call_once(once_, [this] {
    bundle_ = bundleOf(view_, sequence_);
    view_.image.reset();
  });
  return bundle_;
}

std::optional<Live::Viewer> Live::join() {
  int viewers = viewers_;
  do {
    if (viewers >= kMostViewers) return std::nullopt;
  } while (!viewers_.compare_exchange_weak(viewers, viewers + 1));
  return Viewer(*this);
}

void Live::setFrame(FrameView view) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    frame_ = std::make_shared<SharedFrame>(std::move(view), ++frames_);
  }
  changed_.notify_all();
}

void Live::setHealth(std::string text) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    health_ = std::move(text);
    ++health_sequence_;
  }
  changed_.notify_all();
}

void Live::setMap(std::string text) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    map_ = std::move(text);
    ++map_sequence_;
  }
  changed_.notify_all();
}

void Live::forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  frame_.reset();
  health_.clear();
  map_.clear();
}

void Live::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
}

std::shared_ptr<SharedFrame> Live::frame() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return frame_;
}

bool Live::hasNewer(const Sent& sent) const {
  return (frame_ && frames_ > sent.frame) || (!health_.empty() && health_sequence_ > sent.health) ||
         (!map_.empty() && map_sequence_ > sent.map);
}

Live::Update Live::wait(const Sent& sent, std::chrono::milliseconds timeout) const {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, timeout, [&] { return is_closed_ || hasNewer(sent); });
  Update update;
  if (frames_ > sent.frame) update.frame = frame_;
  if (health_sequence_ > sent.health) update.health = health_;
  update.health_sequence = health_sequence_;
  if (map_sequence_ > sent.map) update.map = map_;
  update.map_sequence = map_sequence_;
  update.is_closed = is_closed_;
  return update;
}

}  // namespace redbee
