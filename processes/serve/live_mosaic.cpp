#include "processes/serve/live_mosaic.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace redbee {
namespace {

constexpr int64_t kKept_us = 2'000'000;  ///< of the chain: longer than a frame's way through the stack

}  // namespace

void LiveMosaic::onFused(const fused_homography_t& fused) {
  note(fused, exposures_, chain_);
  chain_.eraseBefore(fused.utime - kKept_us);
  exposures_.erase(exposures_.begin(), exposures_.lower_bound(fused.utime - kKept_us));
  followPlane(fused.utime_previous);
}

/// In the image's lower half: there a plane that is a little off changes least.
Eigen::Vector2d LiveMosaic::nearGround() const {
  return {0.5 * painting_.idealSize().width, 0.75 * painting_.idealSize().height};
}

void LiveMosaic::followPlane(int64_t utime) {
  if (!reference_ || piece_ != chain_.pieces()) return;
  const GroundChain::Frame* frame = chain_.frame(utime);
  if (frame == nullptr) return;
  const Eigen::Matrix3d K = painting_.camera().K();
  const auto misfit = reference_->misfit(*frame, K, nearGround());
  if (!misfit || !fit_.isContradicted(utime, *misfit)) return;
  reference_ = reference_->relaid(*frame, K, nearGround());
  ++maps_;
  fit_.laid(utime);
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
  why_ = !reference_     ? ""
         : is_same_piece ? "the scale is known now"
                         : "no homography led on from the frame before";
  fit_.laid(frame->utime);
  reference_.emplace(*frame, painting_.camera().K());
  piece_ = chain_.pieces();
  ++number_;
  image_utime_ = 0;
  return true;
}

void LiveMosaic::onFrame(const FrameView& view, Time now) {
  if (!view.detections || !isAskedFor(now)) return;
  const GroundChain::Frame* frame = chain_.frame(view.utime);
  if (frame == nullptr || !layMap()) return;
  MosaicFrame waiting;
  waiting.mosaic = number_;
  waiting.map = maps_;
  waiting.why = why_;
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

void LiveMosaic::enqueue(MosaicFrame frame) {
  const std::lock_guard<std::mutex> lock(waiting_mutex_);
  waiting_.push_back(std::move(frame));
  const auto images =
      std::count_if(waiting_.begin(), waiting_.end(), [](const MosaicFrame& w) { return w.image; });
  if (images > static_cast<std::ptrdiff_t>(kMostImages)) {
    const auto oldest =
        std::find_if(waiting_.begin(), waiting_.end(), [](const MosaicFrame& w) { return w.image; });
    oldest->image.reset();
    oldest->mask.clear();
  }
  if (waiting_.size() > kMostFrames) waiting_.pop_front();
}

bool LiveMosaic::release() {
  reference_.reset();
  {
    const std::lock_guard<std::mutex> lock(waiting_mutex_);
    waiting_.clear();
    asked_ = {};
  }
  const std::unique_lock<std::mutex> lock(paint_mutex_, std::try_to_lock);
  if (!lock) return false;
  painting_.clear();
  return true;
}

std::shared_ptr<const std::string> LiveMosaic::newest(int64_t after, Time now) {
  const std::lock_guard<std::mutex> lock(paint_mutex_);
  std::deque<MosaicFrame> frames;
  {
    const std::lock_guard<std::mutex> waiting_lock(waiting_mutex_);
    asked_ = now;
    frames.swap(waiting_);
  }
  for (const MosaicFrame& frame : frames) painting_.add(frame);
  return painting_.newest(after);
}

}  // namespace redbee
