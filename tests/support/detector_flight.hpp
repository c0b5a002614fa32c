// A rendered flight with its exact homographies as input of a detector, and comparison of the detector's
// output with the truth.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "redbee/detection/detector.hpp"
#include "redbee/visual/point_tracker.hpp"
#include "tests/support/rendered_flight.hpp"

namespace redbee::test {

struct DetectorFlight {
  std::vector<FrameInput> inputs;
  std::vector<simulation::RenderedImage> truths;

  /// `front_patch`: the patch whose homography is used as the front plane's, if any.
  DetectorFlight(const simulation::Scenario& scenario, int frames, std::optional<size_t> front_patch = {}) {
    const RenderedFlight flight(scenario, frames);
    TrackerParameters dense;
    dense.grid_px = 16;
    PointTracker tracker{dense};
    for (int k = 0; k < frames; ++k) {
      FrameInput input;
      input.time = flight.simulator().frameTime(k);
      input.grey = flight.image(k).grey;
      input.K = flight.simulator().camera().K();
      if (k > 0) {
        input.time_previous = flight.simulator().frameTime(k - 1);
        input.ground = flight.homography(k);
        if (front_patch) input.front = flight.simulator().frontHomography(k, *front_patch);
        input.motion = flight.motion(k);
      }
      input.sample_grid_px = dense.grid_px;
      input.tracks = tracker.advance(input.grey, input.ground);
      inputs.push_back(input);
      truths.push_back(flight.image(k));
    }
  }
};

/// Pixel counts over all frames.
struct PixelCounts {
  double mover = 0, found = 0;        ///< of the movers, and of these in the mask
  double static_ = 0, false_ = 0;     ///< of everything else, and of these in the mask
  double patch = 0, false_patch = 0;  ///< of one surface, and of these in the mask

  double mover_probability = 0, patch_probability = 0;  ///< summed P_FG, 0..255

  double moverProbability() const { return mover > 0 ? mover_probability / mover : 0; }
  double patchProbability() const { return patch > 0 ? patch_probability / patch : 0; }
  double recall() const { return mover > 0 ? found / mover : 0; }
  double falseFraction() const { return static_ > 0 ? false_ / static_ : 0; }
  double falsePatchFraction() const { return patch > 0 ? false_patch / patch : 0; }

  void add(const simulation::RenderedImage& truth, const DetectorOutput& output, size_t patch_index) {
    const cv::Mat& mask = output.mask;
    const cv::Mat moving = truth.mask == simulation::kMaskMoving;
    const cv::Mat still = truth.mask == 0;
    const cv::Mat surface = truth.surface == static_cast<int>(patch_index + 1);
    mover += cv::countNonZero(moving);
    found += cv::countNonZero(moving & mask);
    static_ += cv::countNonZero(still);
    false_ += cv::countNonZero(still & mask);
    patch += cv::countNonZero(surface);
    false_patch += cv::countNonZero(surface & mask);
    mover_probability += cv::mean(output.probability, moving)[0] * cv::countNonZero(moving);
    patch_probability += cv::mean(output.probability, surface)[0] * cv::countNonZero(surface);
  }
};

/// `change` may modify inputs (e.g. remove the motion). The first frames, while the background is learned,
/// are not counted.
inline PixelCounts detect(const DetectorFlight& flight, const DetectionParameters& parameters, size_t patch,
                          const std::function<void(FrameInput&)>& change = {}) {
  const auto detector = makeDetector(parameters);
  PixelCounts counts;
  const size_t settled = 2 * static_cast<size_t>(parameters.learning_frames);
  for (size_t k = 0; k < flight.inputs.size(); ++k) {
    FrameInput input = flight.inputs[k];
    if (change) change(input);
    const DetectorOutput output = detector->step(input);
    if (k >= settled) counts.add(flight.truths[k], output, patch);
  }
  return counts;
}

}  // namespace redbee::test
