// The boxes of a frame that tracking measures compare.
#pragma once

#include <cstdint>
#include <vector>

#include "redbee/evaluation/object_measures.hpp"
#include "redbee/evaluation/tracking_measures.hpp"

namespace redbee {

struct FrameBoxes {
  std::vector<TrackedBox> truth;
  std::vector<TrackedBox> detected;
};

/// An object has the bounding box of its visible pixels, or the box that it is labelled by. One that does not
/// count, or of which fewer than `least_visible` pixels are visible, is left out.
class ObjectBoxes {
 public:
  ObjectBoxes(const ObjectTruth& truth, int64_t least_visible);

  /// Without the detections of objects that are left out: those whose best match is such an object, and those
  /// that match none and of which more than half lies in ignored areas. A match has an intersection over
  /// union of at least `min_overlap`.
  FrameBoxes compared(const std::vector<TrackedBox>& detected, double min_overlap) const;

 private:
  struct Object {
    TrackedBox box;
    bool counts = false;
  };

  std::vector<Object> objects_;
  cv::Mat1b ignored_;
};

}  // namespace redbee
