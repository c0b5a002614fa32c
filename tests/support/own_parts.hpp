// A camera that sees its own drone: a propeller that flickers in one corner, an arm that stands still in
// another.
#pragma once

#include <opencv2/imgproc.hpp>

#include "tests/support/stack_run.hpp"

namespace redbee::test {

inline const cv::Rect kPropeller(0, 0, 260, 150);
inline const cv::Rect kArm(470, 330, 170, 150);

inline cv::Mat1b maskOfParts() {
  cv::Mat1b mask(480, 640, uchar{0});
  mask(kPropeller).setTo(255);
  mask(kArm).setTo(255);
  return mask;
}

inline void paintParts(cv::Mat1b& image, int k) {
  cv::RNG random(static_cast<uint64_t>(k) + 1);
  cv::Mat1b blades(kPropeller.height / 6, kPropeller.width / 6);
  random.fill(blades, cv::RNG::UNIFORM, 20, 235);
  cv::resize(blades, image(kPropeller), kPropeller.size(), 0, 0, cv::INTER_CUBIC);
  cv::RNG same(99);
  cv::Mat1b arm(kArm.height / 4, kArm.width / 4);
  same.fill(arm, cv::RNG::UNIFORM, 20, 235);
  cv::resize(arm, image(kArm), kArm.size(), 0, 0, cv::INTER_CUBIC);
}

inline StackFlight flightWithParts(const simulation::Scenario& scenario, int frames) {
  StackFlight flight = stackFlight(scenario, frames);
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

}  // namespace redbee::test
