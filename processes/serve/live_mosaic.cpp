#include "processes/serve/live_mosaic.hpp"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <utility>

#include "redbee/image_codec/jpeg.hpp"

namespace redbee {
namespace {

constexpr int64_t kKept_us = 2'000'000;       ///< of the chain: longer than a frame's way through the stack
constexpr int64_t kPointPeriod_us = 100'000;  ///< of a track
constexpr int kQuality = 85;
constexpr int kMostRefused = 20;  ///< five seconds

}  // namespace

void LiveMosaic::onFused(const fused_homography_t& fused) {
  note(fused, exposures_, chain_);
  chain_.eraseBefore(fused.utime - kKept_us);
  exposures_.erase(exposures_.begin(), exposures_.lower_bound(fused.utime - kKept_us));
}

bool LiveMosaic::isAskedFor(Time now) {
  const std::lock_guard<std::mutex> lock(waiting_mutex_);
  return asked_ != Time() && now - asked_ < kAskedFor;
}

/// By the newest plane; returns whether there is a map.
bool LiveMosaic::layMap() {
  const bool is_same_piece = reference_ && piece_ == chain_.pieces();
  if (is_same_piece && reference_->is_metric) return true;
  const GroundChain::Frame* frame = chain_.lastWithPlane();
  if (frame == nullptr && is_same_piece) return true;
  if (frame == nullptr) frame = chain_.lastFrame();
  if (frame == nullptr) return false;
  reference_.emplace(*frame, painter_.camera().K());
  piece_ = chain_.pieces();
  ++number_;
  image_utime_ = 0;
  return true;
}

void LiveMosaic::onFrame(const FrameView& view, Time now) {
  if (!view.detections || !isAskedFor(now)) return;
  const GroundChain::Frame* frame = chain_.frame(view.utime);
  if (frame == nullptr || !layMap()) return;
  Waiting waiting;
  waiting.mosaic = number_;
  waiting.utime = view.utime;
  waiting.to_map = reference_->toMap(*frame);
  waiting.is_metric = reference_->is_metric;
  waiting.detections = *view.detections;
  waiting.exposure = exposureAt(exposures_, view.utime);
  // An image of another time than the last: also where the clock was set back.
  const bool is_due = std::abs(view.utime - image_utime_) >= kImagePeriod_us;
  if (view.image && !view.mask.empty() && is_due) {
    image_utime_ = view.utime;
    waiting.image = view.image;
    waiting.mask = view.mask;
  }
  enqueue(std::move(waiting));
}

void LiveMosaic::enqueue(Waiting frame) {
  const std::lock_guard<std::mutex> lock(waiting_mutex_);
  waiting_.push_back(std::move(frame));
  const auto images =
      std::count_if(waiting_.begin(), waiting_.end(), [](const Waiting& w) { return w.image; });
  if (images > static_cast<std::ptrdiff_t>(kMostImages)) {
    const auto oldest =
        std::find_if(waiting_.begin(), waiting_.end(), [](const Waiting& w) { return w.image; });
    oldest->image.reset();
    oldest->mask.clear();
  }
  if (waiting_.size() > kMostFrames) waiting_.pop_front();
}

void LiveMosaic::release() {
  reference_.reset();
  {
    const std::lock_guard<std::mutex> lock(waiting_mutex_);
    waiting_.clear();
    asked_ = {};
  }
  const std::lock_guard<std::mutex> lock(paint_mutex_);
  mosaic_.reset();
  tracks_.clear();
  bundle_.reset();
}

std::shared_ptr<const std::string> LiveMosaic::newest(int64_t after, Time now) {
  const std::lock_guard<std::mutex> lock(paint_mutex_);
  std::deque<Waiting> frames;
  {
    const std::lock_guard<std::mutex> waiting_lock(waiting_mutex_);
    asked_ = now;
    frames.swap(waiting_);
  }
  for (const Waiting& frame : frames) {
    paint(frame);
    addTracks(frame);
  }
  if (!mosaic_ || sequence_ == after) return nullptr;
  if (!bundle_) bundle_ = std::make_shared<const std::string>(encode());
  return bundle_;
}

void LiveMosaic::paint(const Waiting& frame) {
  if (!frame.image) return;
  const bool is_first = !mosaic_ || frame.mosaic != painted_number_;
  if (is_first) {
    const auto grid =
        gridFor({{{frame.utime, frame.to_map, frame.exposure.zoom}}, frame.is_metric, frame.to_map},
                painter_.idealSize(), kMost_px);
    if (!grid) return;
    mosaic_.emplace(*grid);
    tracks_.clear();
    painted_number_ = frame.mosaic;
    is_metric_ = frame.is_metric;
    start_utime_ = frame.utime;
    frames_ = refused_ = 0;
  } else if (!mosaic_->makeRoomFor(frame.to_map, painter_.idealSize(), kMost_px)) {
    if (++refused_ >= kMostRefused) mosaic_.reset();  // the next begins where the flight is
    return;
  }
  refused_ = 0;
  const ObservedFrame observed{&frame.mask, &frame.detections, frame.exposure};
  if (!painter_.paint(*frame.image, observed, frame.to_map, *mosaic_)) return;
  utime_ = frame.utime;
  ++frames_;
  ++sequence_;
  bundle_.reset();
}

void LiveMosaic::addTracks(const Waiting& frame) {
  if (!mosaic_ || frame.mosaic != painted_number_) return;
  const Camera lens = zoomed(painter_.camera(), frame.exposure.zoom);
  for (const detection_t& d : frame.detections.detections) {
    const auto place = placeOnMap(d, lens, frame.to_map, mosaic_->grid().coarsest_area);
    if (!place) continue;
    std::vector<TrackPoint>& track = tracks_[d.id];
    if (!track.empty() && frame.utime < track.back().utime + kPointPeriod_us) continue;
    track.push_back({frame.utime, *place});
    if (track.size() <= kMostPoints) continue;
    size_t kept = 0;
    for (size_t i = 0; i < track.size(); i += 2) track[kept++] = track[i];
    track.resize(kept);
  }
  const auto isOlder = [](const auto& a, const auto& b) {
    return a.second.back().utime < b.second.back().utime;
  };
  while (tracks_.size() > kMostTracks)
    tracks_.erase(std::min_element(tracks_.begin(), tracks_.end(), isOlder));
}

std::string LiveMosaic::encode() const {
  cv::Mat3b image = mosaic_->image();
  drawTracks(image, tracks_, mosaic_->grid(), start_utime_);
  const std::vector<uint8_t> jpeg = encodeJpeg(image, kQuality);
  const auto tracks =
      std::count_if(tracks_.begin(), tracks_.end(), [](const auto& track) { return isDrawn(track.second); });
  return bundleOf({{"sequence", sequence_},
                   {"width", image.cols},
                   {"height", image.rows},
                   {"image_bytes", jpeg.size()},
                   {"mask_bytes", 0},
                   {"utime", utime_},
                   {"start", start_utime_},
                   {"units_per_px", mosaic_->grid().units_per_px},
                   {"unit", is_metric_ ? "m" : "px"},
                   {"frames", frames_},
                   {"tracks", tracks}},
                  jpeg, {});
}

}  // namespace redbee
