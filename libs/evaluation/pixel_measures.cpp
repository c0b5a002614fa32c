#include "redbee/evaluation/pixel_measures.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "redbee/evaluation/truth_label.hpp"

namespace redbee {
namespace {

OperatingPoint operatingPoint(int threshold, int64_t hits, int64_t false_alarms, int64_t positives) {
  OperatingPoint point;
  point.threshold = threshold;
  const int64_t detected = hits + false_alarms;
  point.precision = detected > 0 ? static_cast<double>(hits) / static_cast<double>(detected) : 1.0;
  point.recall = positives > 0 ? static_cast<double>(hits) / static_cast<double>(positives) : 0.0;
  return point;
}

}  // namespace

void PixelMeasures::add(const cv::Mat1b& probability, const cv::Mat1b& truth) {
  if (probability.size() != truth.size()) {
    throw std::invalid_argument("PixelMeasures: maps must be of one size");
  }
  for (int row = 0; row < truth.rows; ++row) {
    const uint8_t* p = probability[row];
    const uint8_t* t = truth[row];
    for (int column = 0; column < truth.cols; ++column) {
      if (t[column] == kTruthMoving) {
        ++moving_[p[column]];
      } else if (t[column] == kTruthStatic) {
        ++background_[p[column]];
      }
    }
  }
  ++frames_;
}

int64_t PixelMeasures::movingPixels() const {
  return std::accumulate(moving_.begin(), moving_.end(), int64_t{0});
}

int64_t PixelMeasures::backgroundPixels() const {
  return std::accumulate(background_.begin(), background_.end(), int64_t{0});
}

std::vector<OperatingPoint> PixelMeasures::curve() const {
  std::vector<OperatingPoint> points;
  const int64_t positives = movingPixels();
  int64_t hits = 0;
  int64_t false_alarms = 0;
  for (int threshold = 255; threshold >= 1; --threshold) {
    hits += moving_[static_cast<size_t>(threshold)];
    false_alarms += background_[static_cast<size_t>(threshold)];
    points.push_back(operatingPoint(threshold, hits, false_alarms, positives));
  }
  return points;
}

OperatingPoint PixelMeasures::at(int threshold) const {
  const auto from = [&](const auto& counts) {
    return std::accumulate(counts.begin() + std::clamp(threshold, 0, 255), counts.end(), int64_t{0});
  };
  return operatingPoint(threshold, from(moving_), from(background_), movingPixels());
}

double PixelMeasures::errorAtHalfRecall() const {
  const auto points = curve();
  const auto reached = std::find_if(points.begin(), points.end(),
                                    [](const OperatingPoint& point) { return point.recall >= 0.5; });
  if (reached == points.end()) return 1.0;
  if (reached == points.begin() || std::prev(reached)->recall == 0) return 1.0 - reached->precision;
  const OperatingPoint& before = *std::prev(reached);
  const double fraction = (0.5 - before.recall) / (reached->recall - before.recall);
  return 1.0 - (before.precision + fraction * (reached->precision - before.precision));
}

double PixelMeasures::bestF1() const {
  double best = 0;
  for (const OperatingPoint& point : curve()) {
    const double sum = point.precision + point.recall;
    if (point.recall > 0) best = std::max(best, 2 * point.precision * point.recall / sum);
  }
  return best;
}

}  // namespace redbee
