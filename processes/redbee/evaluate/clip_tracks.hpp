// The boxes of a run against the objects of a clip.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "redbee/evaluation/object_boxes.hpp"
#include "redbee/evaluation/tracking_measures.hpp"
#include "redbee/results/detections_csv.hpp"

namespace redbee {

/// Truth objects with fewer visible pixels are not compared.
inline constexpr int64_t kLeastTrackedPixels = 40;

struct TrackingMeasuresAt {
  double min_overlap = 0;
  TrackingMeasures measures;
};

/// One setting of a threshold on the detections' score.
struct BoxOperatingPoint {
  double least_score = 0;
  double recall = 0;
  double false_boxes_per_frame = 0;
};

struct TrackReport {
  bool has_identities = true;                ///< false: identity measures mean nothing
  std::vector<TrackingMeasuresAt> overlaps;  ///< 0.5, the usual; 0.3 and 0.25, for objects of few pixels
  std::vector<BoxOperatingPoint> curve;      ///< at an overlap of 0.3
};

/// Only boxes that the mask supports are compared: those that are seen.
class ClipTracks {
 public:
  explicit ClipTracks(DetectionsByTime detections) : detections_(std::move(detections)) {}

  void add(int64_t utime, const ObjectTruth& truth);
  TrackReport report() const;

 private:
  static constexpr int kScores = 20;

  DetectionsByTime detections_;
  bool has_identities_ = true;
  TrackingEvaluation at_half_, at_third_, at_quarter_;
  std::vector<TrackingEvaluation> by_score_ = std::vector<TrackingEvaluation>(kScores);
};

}  // namespace redbee
