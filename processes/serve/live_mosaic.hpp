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
#include "processes/serve/frame_view.hpp"
#include "processes/serve/map_fit.hpp"
#include "processes/serve/mosaic_painting.hpp"
#include "redbee/fused_homography_t.hpp"

namespace redbee {

/// The thread of the bus only chains homographies, which costs nothing, and while somebody asks for the
/// mosaic keeps a few frames; who asks paints them. It is in metres as soon as a plane is known, and begins
/// anew where no homography leads on from the frame before. Where the ground's plane has contradicted the map
/// for a second, the map is laid anew where the flight is, and what is painted from then on replaces what was
/// there. Bounded: the frames that wait, and what is painted (MosaicPainting).
class LiveMosaic {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kAskedFor{3};  ///< so long after somebody asked
  static constexpr int64_t kImagePeriod_us = 250'000;  ///< between frames that are painted
  static constexpr size_t kMostImages = 8;             ///< that wait
  static constexpr size_t kMostFrames = 128;           ///< that wait, for the tracks

  explicit LiveMosaic(const Configuration& configuration) : painting_(configuration) {}

  /// By the thread of the bus.
  void onFused(const fused_homography_t& fused);
  void onFrame(const FrameView& view, Time now);
  /// Nobody looks at the page at all: the next mosaic begins anew.
  bool release();

  /// By any thread: see MosaicPainting::newest().
  std::shared_ptr<const std::string> newest(int64_t after, Time now);

 private:
  bool isAskedFor(Time now);
  Eigen::Vector2d nearGround() const;
  bool layMap();
  void followPlane(int64_t utime);
  void enqueue(MosaicFrame frame);

  // Of the bus's thread.
  GroundChain chain_;
  Exposures exposures_;
  std::optional<MapReference> reference_;
  size_t piece_ = 0;   ///< of the chain, that the reference belongs to
  size_t number_ = 0;  ///< of the mosaic
  const char* why_ = "";
  size_t maps_ = 0;  ///< that were laid
  MapFit fit_;
  int64_t image_utime_ = 0;

  std::mutex waiting_mutex_;
  std::deque<MosaicFrame> waiting_;
  Time asked_;

  // Of who asks.
  std::mutex paint_mutex_;
  MosaicPainting painting_;
};

}  // namespace redbee
