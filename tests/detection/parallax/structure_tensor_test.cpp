#include "redbee/detection/parallax/structure_tensor.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/instruction_sets.hpp"

namespace redbee::test {
namespace {

using StructureTensor = WithInstructions;
REDBEE_WITH_INSTRUCTIONS(StructureTensor);

cv::Mat3f byOpenCv(const cv::Mat1b& grey, int window_px) {
  constexpr double kGain = 8;
  cv::Mat1f by_x, by_y;
  cv::Sobel(grey, by_x, CV_32F, 1, 0, 3, 1 / kGain);
  cv::Sobel(grey, by_y, CV_32F, 0, 1, 3, 1 / kGain);
  cv::Mat3f tensor;
  cv::merge(std::vector<cv::Mat>{by_x.mul(by_x), by_x.mul(by_y), by_y.mul(by_y)}, tensor);
  cv::blur(tensor, tensor, {window_px, window_px});
  return tensor;
}

TEST_P(StructureTensor, IsThatOfOpenCvToTheBit) {
  cv::RNG random(3);
  for (const cv::Size& size : {cv::Size(64, 48), cv::Size(37, 21), cv::Size(9, 9), cv::Size(3, 5)}) {
    cv::Mat1b grey(size);
    random.fill(grey, cv::RNG::UNIFORM, 0, 256);
    for (const int window_px : {1, 3, 5, 7})
      EXPECT_EQ(cv::norm(structureTensor(grey, window_px), byOpenCv(grey, window_px), cv::NORM_INF), 0)
          << size << ", window " << window_px;
  }
}

TEST_P(StructureTensor, HoldsTheSteepestGradientsOfTheWidestWindow) {
  cv::Mat1b stripes(64, 64);
  for (int x = 0; x < stripes.cols; ++x) stripes.col(x).setTo(x / 2 % 2 == 0 ? 0 : 255);
  EXPECT_LT(cv::norm(structureTensor(stripes, 45), byOpenCv(stripes, 45), cv::NORM_INF), 0.01);
  EXPECT_THROW(structureTensor(stripes, 47), std::invalid_argument);
}

}  // namespace
}  // namespace redbee::test
