// What an evaluation finds out about one clip.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "processes/redbee/evaluate/clip_tracks.hpp"
#include "redbee/evaluation/object_measures.hpp"
#include "redbee/evaluation/pixel_measures.hpp"
#include "redbee/evaluation/region_measures.hpp"

namespace redbee {

/// One labelled frame, by the mask that the method decided on.
struct FrameOutcome {
  int64_t utime = 0;         ///< us
  int64_t hits = 0;          ///< px, moving and in the mask
  int64_t false_alarms = 0;  ///< px, not moving and in the mask
  int64_t misses = 0;        ///< px, moving and not in the mask
  ObjectCounts objects;
};

struct ClipMeasures {
  std::string name;
  bool has_movers = false;            ///< false: recall, error and F1 are undefined
  PixelMeasures pixels;               ///< of P_FG, at every threshold
  PixelMeasures decided;              ///< of the mask, which is the method's own operating point
  RegionMeasures regions;             ///< of the mask
  ObjectMeasures objects;             ///< of the mask
  std::optional<TrackReport> tracks;  ///< of the detections; nothing where the run has none
  std::vector<FrameOutcome> frames;
  int64_t frames_limit = 0;          ///< only the first frames of the recording were evaluated; 0: all were
  int64_t truth_without_result = 0;  ///< labelled frames without a map in the run, counted as empty maps
};

}  // namespace redbee
