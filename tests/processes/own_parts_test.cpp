// A camera that sees its own drone: a propeller that flickers in one corner, an arm that stands still in
// another. With camera.mask they are left out, and the rest is as without them.
#include <gtest/gtest.h>

#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/stack_run.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 72;
constexpr int kSettled = 16;  ///< the background is known by then
const cv::Rect kPropeller(0, 0, 260, 150);
const cv::Rect kArm(470, 330, 170, 150);

cv::Mat1b maskOfParts() {
  cv::Mat1b mask(480, 640, uchar{0});
  mask(kPropeller).setTo(255);
  mask(kArm).setTo(255);
  return mask;
}

void paintParts(cv::Mat1b& image, int k) {
  cv::RNG random(static_cast<uint64_t>(k) + 1);
  cv::Mat1b blades(kPropeller.height / 6, kPropeller.width / 6);
  random.fill(blades, cv::RNG::UNIFORM, 20, 235);
  cv::resize(blades, image(kPropeller), kPropeller.size(), 0, 0, cv::INTER_CUBIC);
  cv::RNG same(99);
  cv::Mat1b arm(kArm.height / 4, kArm.width / 4);
  same.fill(arm, cv::RNG::UNIFORM, 20, 235);
  cv::resize(arm, image(kArm), kArm.size(), 0, 0, cv::INTER_CUBIC);
}

StackFlight flightWithParts(const simulation::Scenario& scenario) {
  StackFlight flight = stackFlight(scenario, kFrames);
  int k = 0;
  for (SensorMessage& sent : flight.messages) {
    if (sent.channel != "CAMERA") continue;
    image_t image;
    image.decode(sent.data.data(), 0, static_cast<int>(sent.data.size()));
    cv::Mat1b grey = decodeGrey(image)->clone();
    paintParts(grey, k++);
    sent = encoded(rawGreyMessage(image.utime, grey));
  }
  return flight;
}

struct Figures {
  double worst_px = 0;  ///< of the ground's homography by vision
  int tracks_on_parts = 0;
  int mask_on_parts = 0;  ///< px
  int unknown_on_parts = 0;
  int false_px = 0;  ///< px of masks beside movers
  int found_px = 0;  ///< px of movers in masks
};

Figures fly(const StackFlight& flight) {
  const cv::Mat1b parts = maskOfParts();
  const StackOutput output = StackRun(flight).run();
  Figures figures;
  for (int k = kSettled; k < kFrames; ++k) {
    const int64_t utime = flight.frame_utimes[static_cast<size_t>(k)];
    const visual_homography_t& visual = output.visual.at(utime);
    figures.worst_px = std::max(
        figures.worst_px, groundError(output.fused.at(utime), flight.homographies[static_cast<size_t>(k)]));
    for (int i = 0; i < visual.tracks.n; ++i) {
      const cv::Point at(cvRound(visual.tracks.x[static_cast<size_t>(i)]),
                         cvRound(visual.tracks.y[static_cast<size_t>(i)]));
      figures.tracks_on_parts += parts(at) != 0 ? 1 : 0;
    }
    const foreground_t& m = output.foreground.at(utime);
    const cv::Mat1b mask = cv::imdecode(m.mask, cv::IMREAD_GRAYSCALE);
    const cv::Mat1b truth = flight.masks[static_cast<size_t>(k)] != 0;
    figures.mask_on_parts += cv::countNonZero(mask & parts);
    figures.unknown_on_parts += cv::countNonZero(cv::imdecode(m.unknown, cv::IMREAD_GRAYSCALE) & parts);
    cv::Mat1b near;
    cv::dilate(truth, near, cv::Mat(), {-1, -1}, 8);
    figures.false_px += cv::countNonZero(mask & ~near);
    figures.found_px += cv::countNonZero(mask & truth & ~parts);
  }
  std::cout << "worst ground error " << figures.worst_px << " px, " << figures.tracks_on_parts
            << " tracks on the parts, mask " << figures.mask_on_parts << " px on them, " << figures.false_px
            << " px false in all, " << figures.found_px << " px of movers\n";
  return figures;
}

void expectLeftOut(const simulation::Scenario& scenario) {
  StackFlight flight = flightWithParts(scenario);
  const Figures seen = fly(flight);
  flight.configuration.own_parts = maskOfParts();
  const Figures left_out = fly(flight);
  EXPECT_GT(seen.tracks_on_parts, 0) << "the trial has no difficulty";
  EXPECT_GT(seen.mask_on_parts, 1000) << "the trial has no difficulty";
  EXPECT_EQ(left_out.tracks_on_parts, 0);
  EXPECT_EQ(left_out.mask_on_parts, 0);
  EXPECT_EQ(left_out.unknown_on_parts, (kFrames - kSettled) * cv::countNonZero(maskOfParts()));
  EXPECT_LT(left_out.worst_px, 1);
  EXPECT_LT(left_out.false_px, seen.false_px / 4);
  EXPECT_GT(left_out.found_px, 0);
}

TEST(OwnParts, AreLeftOutOfTracksAndMasks) { expectLeftOut(simulation::walkers(2)); }

}  // namespace
}  // namespace redbee::test
