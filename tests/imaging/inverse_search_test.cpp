#include "redbee/imaging/inverse_search.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <string>

#include "tests/support/instruction_sets.hpp"

namespace redbee {
namespace {

/// The scalar reference: OpenCV's.
cv::Mat2f opencvFlow(const InverseSearchParameters& parameters, const cv::Mat1b& from, const cv::Mat1b& to) {
  const auto dis = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_ULTRAFAST);
  dis->setFinestScale(parameters.finest_scale);
  dis->setGradientDescentIterations(parameters.iterations);
  dis->setPatchStride(parameters.stride_px);
  cv::Mat2f flow;
  dis->calc(from, to, flow);
  return flow;
}

cv::Mat1b texture(cv::Size size, uint64_t seed, double blur_px) {
  cv::Mat1b image(size);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, 256);
  if (blur_px > 0) cv::GaussianBlur(image, image, {0, 0}, blur_px);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

/// Moved, turned and brightened.
cv::Mat1b moved(const cv::Mat1b& image, double x, double y, double turn) {
  const cv::Matx23d M(1, -turn, x, turn, 1, y);
  cv::Mat1b to;
  cv::warpAffine(image, to, M, image.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return to * 0.9 + 10;
}

/// To the bit on x86-64. Elsewhere OpenCV rounds otherwise, probably by fused multiplications, which our
/// kernels avoid: there the mean of the differences [px] is bounded, as in noise a pixel may follow another
/// neighbour.
void expectSameFlow(const cv::Mat2f& ours, const cv::Mat2f& opencvs) {
#ifdef __x86_64__
  EXPECT_EQ(cv::norm(ours, opencvs, cv::NORM_INF), 0);
#else
  constexpr double kRounding_px = 0.01;
  const double mean_px = cv::norm(ours, opencvs, cv::NORM_L1) / (2 * static_cast<double>(ours.total()));
  EXPECT_LT(mean_px, kRounding_px) << "at most " << cv::norm(ours, opencvs, cv::NORM_INF);
  testing::Test::RecordProperty("mean_px", std::to_string(mean_px));
#endif
}

void expectSame(const InverseSearchParameters& parameters, const cv::Mat1b& from, const cv::Mat1b& to) {
  InverseSearch search(parameters);
  expectSameFlow(search.flow(from, to), opencvFlow(parameters, from, to));
  SCOPED_TRACE("buffers are used again");
  expectSameFlow(search.flow(to, from), opencvFlow(parameters, to, from));
}

class InverseSearchWith : public test::WithInstructions {};
REDBEE_WITH_INSTRUCTIONS(InverseSearchWith);

TEST_P(InverseSearchWith, IsOpenCvsToTheBit) {
  const cv::Mat1b image = texture({320, 240}, 1, 2);
  expectSame({}, image, moved(image, 2.3, -1.6, 0.01));
  expectSame({}, image, moved(image, 15, 9, 0));
}

TEST_P(InverseSearchWith, IsOpenCvsForImagesOfAnySize) {
  for (const cv::Size size : {cv::Size(83, 61), cv::Size(160, 120), cv::Size(427, 240), cv::Size(45, 131)}) {
    const cv::Mat1b image = texture(size, 2, 1.5);
    expectSame({}, image, moved(image, -1.2, 0.7, -0.02));
  }
}

TEST_P(InverseSearchWith, IsOpenCvsForOtherParameters) {
  const cv::Mat1b image = texture({320, 240}, 3, 3);
  for (const InverseSearchParameters& parameters :
       {InverseSearchParameters{1, 4, 5}, {2, 4, 5}, {0, 12, 4}, {0, 5, 3}}) {
    expectSame(parameters, image, moved(image, 3.5, 2, 0.02));
  }
}

TEST_P(InverseSearchWith, IsOpenCvsForNoiseAndForNothing) {
  expectSame({}, texture({320, 240}, 4, 0), texture({320, 240}, 5, 0));
  const cv::Mat1b grey(240, 320, uint8_t{128});
  expectSame({}, grey, grey);
  expectSame({}, texture({320, 240}, 4, 0), grey);
}

TEST(InverseSearch, RefusesWhatItCannotSearch) {
  EXPECT_THROW(InverseSearch({}).flow(cv::Mat1b(240, 320), cv::Mat1b(240, 319)), std::invalid_argument);
  EXPECT_THROW(InverseSearch({}).flow(cv::Mat1b(7, 320), cv::Mat1b(7, 320)), std::invalid_argument);
}

}  // namespace
}  // namespace redbee
