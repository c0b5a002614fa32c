#include "redbee/detection/refinement/flow_entropy.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace redbee {
namespace {

const Eigen::Matrix3d kStill = Eigen::Matrix3d::Identity();
constexpr int kGrid_px = 24;

TEST(FlowEntropy, OfAHistogram) {
  EXPECT_DOUBLE_EQ(histogramEntropy({7, 0, 0, 0}), 0);
  EXPECT_DOUBLE_EQ(histogramEntropy({3, 3, 3, 3}), 2);
  EXPECT_DOUBLE_EQ(histogramEntropy({0, 0}), 0);
}

PointTracks cellOf(double flow_px, bool coherent) {
  PointTracks tracks;
  for (int i = 0; i < 16; ++i) {
    const double angle = coherent ? 0.1 : 2 * M_PI * (i + 0.5) / 16;
    const int column = i % 4, row = i / 4;
    const cv::Point2f before(static_cast<float>(8 + 16 * column), static_cast<float>(8 + 16 * row));
    tracks.previous.push_back(before);
    tracks.current.emplace_back(before.x + static_cast<float>(flow_px * std::cos(angle)),
                                before.y + static_cast<float>(flow_px * std::sin(angle)));
  }
  return tracks;
}

TEST(FlowEntropy, OrderedFlowScoresOneAndDisorderedFlowLittle) {
  const RefinementParameters parameters;
  const cv::Size image(64, 64);
  EXPECT_FLOAT_EQ(flowOrder(cellOf(2, true), kGrid_px, kStill, image, parameters).at<float>(30, 30), 1);
  const double flattest = parameters.entropy_floor / std::log2(parameters.entropy_bins);
  EXPECT_LT(flowOrder(cellOf(2, false), kGrid_px, kStill, image, parameters).at<float>(30, 30),
            1.1 * flattest);
}

TEST(FlowEntropy, FlowBelowTheNoiseHasNoDirection) {
  const RefinementParameters parameters;
  const float order =
      flowOrder(cellOf(0.5 * parameters.flow_noise_px, true), kGrid_px, kStill, {64, 64}, parameters)
          .at<float>(30, 30);
  EXPECT_FLOAT_EQ(order, static_cast<float>(parameters.entropy_floor / std::log2(parameters.entropy_bins)));
}

TEST(FlowEntropy, ACellWithoutTracksHasNoEntropy) {
  EXPECT_FLOAT_EQ(flowOrder(cellOf(2, false), kGrid_px, kStill, {128, 64}, {}).at<float>(30, 100), 1);
}

}  // namespace
}  // namespace redbee
