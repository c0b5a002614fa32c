// Images of where a method was right and where it was wrong.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "processes/redbee/evaluate/clip_truth.hpp"
#include "processes/redbee/evaluate/evaluate.hpp"

namespace redbee {

/// The frames worth a look: the best (greatest intersection over union of mask and truth; none where nothing
/// moves) and the worst (least; most false pixels where nothing moves), no two of them within a tenth of the
/// clip, in the order of time. Positions in `frames`.
struct TellingFrames {
  std::vector<size_t> best;
  std::vector<size_t> worst;
};
TellingFrames chooseTellingFrames(const std::vector<FrameOutcome>& frames, size_t of_each);

/// The frame in grey, and on it green: hit, red: false alarm, blue: missed; hatched where the truth is not
/// known. `truth` empty: the mask in yellow, the objects' boxes in white (blue where they are missed is not
/// told).
cv::Mat drawHitsAndMisses(const cv::Mat& grey, const cv::Mat& detected, const ClipTruth::Labels& truth);

/// images/best-<us>.jpg and worst-<us>.jpg in the results folder; earlier ones are removed.
void writeHitsAndMisses(const EvaluateOptions& options, const ClipTruth& truth, const ClipMeasures& clip);

}  // namespace redbee
