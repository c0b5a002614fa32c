#include "processes/redbee/evaluate/clip_tracks.hpp"

namespace redbee {
namespace {

constexpr double kHalf = 0.5, kThird = 0.3, kQuarter = 0.25;

void addTo(TrackingEvaluation& evaluation, const ObjectBoxes& objects,
           const std::vector<TrackedBox>& detected, double min_overlap) {
  const FrameBoxes boxes = objects.compared(detected, min_overlap);
  evaluation.add(boxes.truth, boxes.detected);
}

}  // namespace

void ClipTracks::add(int64_t utime, const ObjectTruth& truth) {
  has_identities_ = has_identities_ && truth.has_identities;
  std::vector<TrackedBox> boxes;
  std::vector<double> scores;
  const auto [begin, end] = detections_.equal_range(utime);
  for (auto it = begin; it != end; ++it) {
    if (!it->second.seen) continue;
    boxes.push_back({it->second.id, cv::Rect2d(it->second.box)});
    scores.push_back(it->second.score);
  }
  const ObjectBoxes objects(truth, kLeastTrackedPixels);
  addTo(at_half_, objects, boxes, kHalf);
  addTo(at_third_, objects, boxes, kThird);
  addTo(at_quarter_, objects, boxes, kQuarter);
  for (int step = 0; step < kScores; ++step) {
    std::vector<TrackedBox> kept;
    for (size_t i = 0; i < boxes.size(); ++i) {
      if (scores[i] * kScores >= step) kept.push_back(boxes[i]);
    }
    addTo(by_score_[static_cast<size_t>(step)], objects, kept, kThird);
  }
}

TrackReport ClipTracks::report() const {
  TrackReport report;
  report.has_identities = has_identities_;
  report.overlaps = {{kHalf, at_half_.measures(kHalf)},
                     {kThird, at_third_.measures(kThird)},
                     {kQuarter, at_quarter_.measures(kQuarter)}};
  for (int step = 0; step < kScores; ++step) {
    const TrackingMeasures measures = by_score_[static_cast<size_t>(step)].measures(kThird);
    report.curve.push_back(
        {static_cast<double>(step) / kScores, measures.recall, measures.false_boxes_per_frame});
  }
  return report;
}

}  // namespace redbee
