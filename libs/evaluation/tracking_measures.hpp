// Measures of tracked boxes against tracked truth, by the definitions of TrackEval: CLEAR MOT (Bernardin and
// Stiefelhagen 2008), identity (Ristani et al. 2016) and HOTA (Luiten et al. 2021). Boxes match by
// intersection over union.
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

struct TrackedBox {
  int id = 0;
  cv::Rect2d box;  ///< px
};

struct TrackingMeasures {
  int64_t frames = 0;
  int64_t truths = 0;      ///< boxes of the truth
  int64_t detections = 0;  ///< boxes of the tracker
  // CLEAR, at the overlap that was asked for.
  int64_t matches = 0;
  int64_t id_switches = 0;
  double recall = 0;                 ///< matched fraction of the truth
  double false_boxes_per_frame = 0;  ///< unmatched boxes of the tracker
  double mean_overlap = 0;           ///< of the matches
  double mota = 0;                   ///< at most 1, may be negative
  // Identity, at the same overlap.
  double idf1 = 0;
  // Means over the overlaps 0.05, 0.10 ... 0.95.
  double hota = 0;
  double detection_accuracy = 0;
  double association_accuracy = 0;
};

/// Keeps the frames; what is measured over the whole sequence is computed by measures().
class TrackingEvaluation {
 public:
  /// Identities are unique inside a frame; throws std::invalid_argument where they are not.
  void add(const std::vector<TrackedBox>& truth, const std::vector<TrackedBox>& detected);
  /// `min_overlap`: the least intersection over union of a match for CLEAR and identity. All measures of a
  /// sequence without truth and detections are 0.
  TrackingMeasures measures(double min_overlap = 0.5) const;

 private:
  struct Frame {
    std::vector<int> truth;     ///< indices of identities
    std::vector<int> detected;  ///< likewise
    cv::Mat1d overlap;          ///< truth x detected
  };

  void addClear(double min_overlap, TrackingMeasures& measures) const;
  void addIdentity(double min_overlap, TrackingMeasures& measures) const;
  void addHota(TrackingMeasures& measures) const;

  std::vector<Frame> frames_;
  std::map<int, int> truth_index_, detected_index_;  ///< by identity
};

}  // namespace redbee
