#include "redbee/detection/parallax/structure_tensor.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/instruction_sets.hpp"

namespace redbee::test {
namespace {

using DisplacementCovariances = WithInstructions;
REDBEE_WITH_INSTRUCTIONS(DisplacementCovariances);
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

TEST_P(DisplacementCovariances, AreTheScalarOnesToTheBit) {
  cv::RNG random(6);
  cv::Mat3f tensors(3, 37), covariances(tensors.size());
  for (cv::Vec3f& S : tensors) {
    const float x = random.uniform(-30.0F, 30.0F), y = random.uniform(-30.0F, 30.0F),
                more = random.uniform(0.0F, 9.0F);
    S = {x * x + more, x * y, y * y + more};
  }
  tensors(0, 0) = {0, 0, 0};
  tensors(1, 1) = {900, 0, 0};
  displacementCovariances(tensors, 0.25F, 64, covariances);
  for (int y = 0; y < tensors.rows; ++y) {
    for (int x = 0; x < tensors.cols; ++x)
      EXPECT_EQ(covariances(y, x), displacementCovariance(tensors(y, x), 0.25F, 64)) << y << ' ' << x;
  }
}

}  // namespace
}  // namespace redbee::test
