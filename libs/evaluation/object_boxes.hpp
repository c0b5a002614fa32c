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
/// count, or of which fewer than `least_visible` pixels are visible, is left out, and so is a detection of
/// it: one whose best match is such an object, or of which more than half lies in ignored areas while it
/// matches none. A match has an intersection over union of at least `min_overlap`.
FrameBoxes comparedBoxes(const ObjectTruth& truth, const std::vector<TrackedBox>& detected,
                         int64_t least_visible, double min_overlap);

}  // namespace redbee
