#include "redbee/detection/rivals/aurora.hpp"

#include <gtest/gtest.h>

#include <random>

namespace redbee {
namespace {

/// 1 / (1 + |x - mean|^2 + variance) over all values so far.
double batchDensity(const std::vector<cv::Vec3d>& values) {
  cv::Vec3d mean;
  double squares = 0;
  for (const cv::Vec3d& value : values) {
    mean += value;
    squares += value.dot(value);
  }
  const auto count = static_cast<double>(values.size());
  mean /= count;
  const cv::Vec3d off = values.back() - mean;
  return 1 / (1 + off.dot(off) + squares / count - mean.dot(mean));
}

TEST(RecursiveDensity, EqualsTheDensityOfAllValues) {
  RecursiveDensity::Parameters parameters;
  parameters.longest = 1000;
  RecursiveDensity density(cv::Size(1, 1), parameters);
  std::mt19937 random(1);
  std::uniform_int_distribution<int> grey(60, 140);
  std::vector<cv::Vec3d> values;
  std::vector<double> past;
  for (int k = 0; k < 50; ++k) {
    const cv::Vec3b colour(static_cast<uint8_t>(grey(random)), static_cast<uint8_t>(grey(random)),
                           static_cast<uint8_t>(grey(random)));
    values.push_back(cv::Vec3d(colour) / parameters.unit);
    const cv::Mat below = density.update(cv::Mat(1, 1, CV_8UC3, cv::Scalar(colour)));
    const double expected = batchDensity(values);
    EXPECT_NEAR(density.density().at<float>(0, 0), expected, 1e-4 * expected) << k;
    if (k >= parameters.learning_frames) {
      double mean = 0, squares = 0;
      for (const double d : past) {
        mean += d / static_cast<double>(past.size());
        squares += d * d / static_cast<double>(past.size());
      }
      const double deviation = std::max<double>(parameters.least_deviation, std::sqrt(squares - mean * mean));
      EXPECT_NEAR(below.at<float>(0, 0), std::max(0.0, (mean - expected) / deviation), 1e-2);
    }
    if (k + 1 >= parameters.learning_frames) past.push_back(expected);
  }
}

TEST(RecursiveDensity, WhatComesIntoViewIsNotScored) {
  RecursiveDensity density({40, 30}, {});
  cv::Mat image(30, 40, CV_8UC3, cv::Scalar(100, 100, 100));
  for (int k = 0; k < 10; ++k) density.update(image);
  density.propagate(cv::Matx33d(1, 0, -10, 0, 1, 0, 0, 0, 1));
  image.setTo(cv::Scalar(200, 200, 200));
  const cv::Mat below = density.update(image);
  EXPECT_GT(below.at<float>(15, 10), 1);
  EXPECT_EQ(below.at<float>(15, 35), 0);
}

}  // namespace
}  // namespace redbee
