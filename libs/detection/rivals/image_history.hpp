// The images of the latest frames, each with the homography from it to the newest.
#pragma once

#include <deque>
#include <opencv2/core.hpp>

namespace redbee {

class ImageHistory {
 public:
  /// `frames`: capacity, at least 1.
  explicit ImageHistory(size_t frames) : frames_(frames) {}

  void clear() { entries_.clear(); }
  bool empty() const { return entries_.empty(); }
  /// To be called before a new frame is pushed. `H`: from the previous frame to the new one.
  void propagate(const cv::Matx33d& H) {
    for (Entry& entry : entries_) entry.to_newest = H * entry.to_newest;
  }
  /// Adds the newest image (not copied).
  void push(const cv::Mat1b& image) {
    entries_.push_back({image, cv::Matx33d::eye()});
    if (entries_.size() > frames_) entries_.pop_front();
  }
  const cv::Mat1b& oldest() const { return entries_.front().image; }
  const cv::Matx33d& oldestToNewest() const { return entries_.front().to_newest; }

 private:
  struct Entry {
    cv::Mat1b image;
    cv::Matx33d to_newest;
  };
  size_t frames_;
  std::deque<Entry> entries_;
};

}  // namespace redbee
