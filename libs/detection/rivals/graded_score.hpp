// The common scale of all rivals' scores.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace redbee {

/// Score at a method's decision threshold.
inline constexpr int kDecisionScore = 128;

/// `ratio`: a statistic over its decision threshold, >= 0. 0 gives 0, 1 gives kDecisionScore, infinity gives
/// 255: 255 r / (1 + r), so that a sweep over the 8 bits sees ratios from 1/250 to 250.
inline uint8_t gradedScore(float ratio) {
  return ratio > 0 ? static_cast<uint8_t>(255.5F - 255.0F / (1.0F + ratio)) : uint8_t{0};
}

/// The same for a map of a statistic.
inline cv::Mat1b gradedScore(const cv::Mat1f& statistic, float threshold) {
  cv::Mat1b score(statistic.size());
  for (int y = 0; y < score.rows; ++y) {
    const float* from = statistic[y];
    uint8_t* to = score[y];
    for (int x = 0; x < score.cols; ++x) to[x] = gradedScore(from[x] / threshold);
  }
  return score;
}

/// A score averaged over a box and graded again, with the decision at a mean of `decision_fraction` of the
/// range; fills holes and removes speckles.
inline cv::Mat1b averagedScore(const cv::Mat1b& score, int box_px, float decision_fraction) {
  cv::Mat1f mean;
  score.convertTo(mean, CV_32F, 1.0 / 255);
  cv::blur(mean, mean, {box_px, box_px});
  return gradedScore(mean, decision_fraction);
}

}  // namespace redbee
