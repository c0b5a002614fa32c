// The newest frame, the map and the processes' health, handed from the thread of the bus to those of the
// viewers.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "processes/serve/frame_view.hpp"

namespace redbee {

/// A frame that is encoded once, by the first viewer who asks for it.
class SharedFrame {
 public:
  SharedFrame(FrameView view, int64_t sequence) : view_(std::move(view)), sequence_(sequence) {}
  int64_t sequence() const { return sequence_; }
  int64_t utime() const { return view_.utime; }
  /// See bundleOf(). To be called by any thread.
  const std::string& bundle();

 private:
  FrameView view_;
  int64_t sequence_;
  std::once_flag once_;
  std::string bundle_;
};

/// Only the newest is kept: who is slow misses frames, and nothing is queued for anybody.
class Live {
 public:
  /// Who looks; the images are received only while somebody does.
  class Viewer {
   public:
    Viewer(Viewer&& other) noexcept : live_(std::exchange(other.live_, nullptr)) {}
    Viewer& operator=(Viewer&&) = delete;
    ~Viewer() {
      if (live_ != nullptr) --live_->viewers_;
    }

   private:
    friend class Live;
    explicit Viewer(Live& live) : live_(&live) {}  ///< counted by join()
    Live* live_;
  };
  /// std::nullopt where there are as many as the server has threads for.
  std::optional<Viewer> join();
  static constexpr int kMostViewers = 16;
  int viewers() const { return viewers_; }

  void setFrame(FrameView view);
  /// `text`: JSON, see HealthReport.
  void setHealth(std::string text);
  /// `text`: JSON, see mapJson().
  void setMap(std::string text);
  /// Nobody looks: whoever comes next is shown what comes next, and nothing of before.
  void forget();
  /// From now on nobody waits.
  void close();

  /// Null before the first frame.
  std::shared_ptr<SharedFrame> frame() const;

  struct Update {
    std::shared_ptr<SharedFrame> frame;  ///< null: no newer one
    std::string health;                  ///< empty: nothing newer
    int64_t health_sequence = 0;
    std::string map;  ///< empty: nothing newer
    int64_t map_sequence = 0;
    bool is_closed = false;
  };
  /// What a viewer has been sent: the numbers of an Update.
  struct Sent {
    int64_t frame = 0;
    int64_t health = 0;
    int64_t map = 0;
  };
  /// Waits until something is newer than what was sent, at most so long.
  Update wait(const Sent& sent, std::chrono::milliseconds timeout) const;

 private:
  bool hasNewer(const Sent& sent) const;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::shared_ptr<SharedFrame> frame_;
  int64_t frames_ = 0;
  std::string health_;
  int64_t health_sequence_ = 0;
  std::string map_;
  int64_t map_sequence_ = 0;
  bool is_closed_ = false;
  std::atomic<int> viewers_{0};
};

}  // namespace redbee
