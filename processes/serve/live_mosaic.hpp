// The ground as one image that grows while the stack flies: by what `redbee mosaic` is made of, for those who
// look at it.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "processes/redbee/mosaic/ground_observer.hpp"
#include "processes/redbee/mosaic/track_drawing.hpp"
#include "processes/serve/frame_view.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/fused_homography_t.hpp"

namespace redbee {

/// The thread of the bus only chains homographies, which costs nothing, and while somebody asks for the
/// mosaic keeps a few frames; who asks paints them. It is in metres as soon as a plane is known, and begins
/// anew where no homography leads on from the frame before. Bounded: the image, the frames that wait, the
/// tracks.
class LiveMosaic {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr int kMost_px = 1280;                ///< of a side
  static constexpr std::chrono::seconds kAskedFor{3};  ///< so long after somebody asked
  static constexpr int64_t kImagePeriod_us = 250'000;  ///< between frames that are painted
  static constexpr size_t kMostImages = 8;             ///< that wait
  static constexpr size_t kMostFrames = 128;           ///< that wait, for the tracks
  static constexpr size_t kMostTracks = 200;           ///< the newest
  static constexpr size_t kMostPoints = 500;           ///< of a track; of a longer one every second goes

  explicit LiveMosaic(const Configuration& configuration)
      : painter_(configuration.camera, configuration.own_parts) {}

  /// By the thread of the bus.
  void onFused(const fused_homography_t& fused);
  void onFrame(const FrameView& view, Time now);
  /// Nobody looks at the page at all: the next mosaic begins anew.
  void release();

  /// By any thread: a bundle of bundleOf() whose JSON has sequence, width, height, utime (us, of the newest
  /// frame), units_per_px, unit ("m" or "px"), frames and tracks. Null where its number is still `after`, or
  /// where there is nothing yet.
  std::shared_ptr<const std::string> newest(int64_t after, Time now);

 private:
  struct Waiting {
    size_t mosaic = 0;  ///< which it belongs to
    int64_t utime = 0;  ///< us
    Eigen::Matrix3d to_map;
    bool is_metric = false;
    detections_t detections;
    std::shared_ptr<const image_t> image;  ///< null: for the tracks alone
    std::vector<uint8_t> mask;
    Exposure exposure;
  };

  bool isAskedFor(Time now);
  bool layMap();
  void enqueue(Waiting frame);
  void paint(const Waiting& frame);
  void addTracks(const Waiting& frame);
  std::string encode() const;

  // Of the bus's thread.
  GroundChain chain_;
  Exposures exposures_;
  std::optional<MapReference> reference_;
  size_t piece_ = 0;   ///< of the chain, that the reference belongs to
  size_t number_ = 0;  ///< of the mosaic
  int64_t image_utime_ = 0;

  std::mutex waiting_mutex_;
  std::deque<Waiting> waiting_;
  Time asked_;

  // Of who asks.
  std::mutex paint_mutex_;
  FramePainter painter_;
  std::optional<Mosaic> mosaic_;
  GroundTracks tracks_;
  size_t painted_number_ = 0;
  bool is_metric_ = false;
  int64_t start_utime_ = 0;
  int64_t utime_ = 0;
  int64_t frames_ = 0;
  int refused_ = 0;  ///< in a row
  int64_t sequence_ = 0;
  std::shared_ptr<const std::string> bundle_;  ///< of `sequence_`; null: to be made
};

}  // namespace redbee
