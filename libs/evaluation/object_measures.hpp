// Object-level measures: which moving objects a mask finds in a frame, and its false alarms.
//
// An object whose visible pixels are labelled is found where the mask covers at least a quarter of them. One
// that is labelled by a box is found where a component of the mask (8-connected) has a bounding box whose
// intersection over union with it is at least 0.2, both boxes grown by 2 px to all sides: labels by hand are
// off by 1 to 2 px, which would decide for objects of a few pixels.
//
// A false alarm is a component of the mask that touches no object (not even one that does not count) and of
// which at most half lies in ignored areas. Its area is that of its pixels outside ignored areas.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

struct TruthObject {
  int id = 0;
  cv::Rect2d box;      ///< px; used where the frame has no map of identities
  bool counts = true;  ///< false: stopped for now, or hidden: neither found nor missed
};

/// The objects of one frame.
struct ObjectTruth {
  cv::Mat1i ids;      ///< identity of each visible pixel, 0: none; empty where objects are labelled by boxes
  cv::Mat1b ignored;  ///< not 0 where the truth is unknown; empty: known everywhere
  std::vector<TruthObject> objects;
  bool has_identities = true;  ///< false: `id` means nothing beyond the frame
};

struct ObjectCounts {
  int64_t present = 0;       ///< moving objects that count
  int64_t found = 0;         ///< of those
  int64_t false_alarms = 0;  ///< components
  int64_t false_area = 0;    ///< px^2, of these
};

/// With fewer visible pixels an object does not count, though it is no false alarm either.
inline constexpr int64_t kLeastVisiblePixels = 12;

/// Every 8-connected region of a 0/255 mask (other values are ignored areas) taken for an object that counts.
ObjectTruth objectsOfMask(const cv::Mat1b& mask);

/// `detected`: not 0 where the method detects motion. Throws std::invalid_argument on maps of different
/// sizes.
ObjectCounts countObjects(const cv::Mat1b& detected, const ObjectTruth& truth);

class ObjectMeasures {
 public:
  ObjectCounts add(const cv::Mat1b& detected, const ObjectTruth& truth);

  int64_t frames() const { return frames_; }
  const ObjectCounts& counts() const { return counts_; }
  /// Found of present, over all frames; 0 where none is present.
  double recall() const;
  double falseAlarmsPerFrame() const;
  /// Mean over the frames of the false alarms' fraction of the image, 0 to 1.
  double falseAreaFraction() const;

 private:
  ObjectCounts counts_;
  double area_fraction_sum_ = 0;
  int64_t frames_ = 0;
};

}  // namespace redbee
