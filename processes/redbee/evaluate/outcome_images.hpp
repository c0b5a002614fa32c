// Images of hits, false alarms and misses of a method.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "processes/redbee/evaluate/clip_measures.hpp"
#include "processes/redbee/evaluate/clip_truth.hpp"
#include "redbee/results/run_folder.hpp"

namespace redbee {

/// The best frames (greatest intersection over union of mask and truth; none where nothing moves) and the
/// worst (least intersection over union; most false pixels where nothing moves), no two of them within a
/// tenth of the clip, each in the order of time. Positions in `frames`.
struct RepresentativeFrames {
  std::vector<size_t> best;
  std::vector<size_t> worst;
};
RepresentativeFrames chooseRepresentativeFrames(const std::vector<FrameOutcome>& frames, size_t of_each);

/// The frame in grey with hits, false alarms and misses in colour; hatched where the truth is unknown. If
/// only boxes are labelled (`truth.mask` is empty), the mask has one colour and the boxes are white.
cv::Mat3b drawOutcome(const cv::Mat1b& grey, const cv::Mat1b& detected, const ClipTruth::Labels& truth);
/// Legend of the colours, as a paragraph of HTML.
std::string outcomeLegend();

/// A flight and the results of a run over it.
struct EvaluatedRun {
  std::filesystem::path log;
  std::string camera_channel;
  RunFolder results;
};
/// Writes images/best-<us>.jpg and images/worst-<us>.jpg in the results folder; earlier ones are removed.
void writeOutcomeImages(const EvaluatedRun& run, const ClipTruth& truth,
                        const std::vector<FrameOutcome>& frames);

}  // namespace redbee
