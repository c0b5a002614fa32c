// Feeds a simulated flight, with its exact homographies, to the segmentation and compares with the truth.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "segmentation/motion_segmenter.hpp"
#include "simulation/flight_simulator.hpp"
#include "simulation/imu_simulator.hpp"
#include "visual/point_tracker.hpp"

namespace redbee::testing {

/// The same flight seen by a camera of half the size: for tests of order and statuses, which need no detail.
inline simulation::Scenario halfSize(simulation::Scenario scenario) {
  CameraIntrinsics& camera = scenario.intrinsics;
  camera = {camera.width / 2,
            camera.height / 2,
            camera.fx / 2,
            camera.fy / 2,
            (camera.cx - 0.5) / 2,
            (camera.cy - 0.5) / 2,
            {}};
  return scenario;
}

/// The inputs of frames in order; the tracker sees every one.
class InputSource {
 public:
  explicit InputSource(const simulation::Scenario& scenario)
      : simulator_(scenario), tracker_(TrackerParameters{}) {}

  const simulation::FlightSimulator& simulator() const { return simulator_; }
  const simulation::RenderedPicture& truth() const { return truth_; }

  SegmentationInput input(int k) {
    const simulation::SimulatedFrame frame = simulator_.frame(k);
    truth_ = frame.picture;
    SegmentationInput input;
    input.utime = frame.utime;
    input.grey = frame.picture.grey;
    input.K = simulator_.camera().K();
    if (k > 0) {
      input.utime_previous = simulator_.frameUtime(k - 1);
      input.ground = simulator_.homography(k);
      input.motion =
          simulation::exactMotion(simulator_.scenario().trajectory, simulator_.scenario().extrinsics,
                                  simulator_.exposureTime(k - 1), simulator_.exposureTime(k));
    }
    input.tracks = tracker_.advance(input.grey, input.ground);
    return input;
  }

 private:
  simulation::FlightSimulator simulator_;
  PointTracker tracker_;
  simulation::RenderedPicture truth_;
};

/// Pixels, pooled over frames.
struct PixelCounts {
  double mover = 0, found = 0;        ///< of the movers, and of these in the mask
  double static_ = 0, false_ = 0;     ///< of everything else, and of these in the mask
  double patch = 0, false_patch = 0;  ///< of one surface, and of these in the mask

  double mover_probability = 0, patch_probability = 0;  ///< summed P_FG, 0..255

  double moverProbability() const { return mover > 0 ? mover_probability / mover : 0; }
  double patchProbability() const { return patch > 0 ? patch_probability / patch : 0; }
  double recall() const { return mover > 0 ? found / mover : 0; }
  double falseShare() const { return static_ > 0 ? false_ / static_ : 0; }
  double falsePatchShare() const { return patch > 0 ? false_patch / patch : 0; }

  void add(const simulation::RenderedPicture& truth, const SegmentationOutput& output, size_t patch_index) {
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

/// `change` may alter an input before it is used (drop the motion, add the front plane).
inline PixelCounts fly(const simulation::Scenario& scenario, const SegmentationParameters& parameters,
                       int frames, size_t patch,
                       const std::function<void(int, InputSource&, SegmentationInput&)>& change = {}) {
  InputSource source(scenario);
  MotionSegmenter segmenter(parameters);
  PixelCounts counts;
  const int settled = 2 * parameters.learning_frames;
  for (int k = 0; k < frames; ++k) {
    SegmentationInput input = source.input(k);
    if (change) change(k, source, input);
    const SegmentationOutput output = segmenter.step(input);
    if (k >= settled) counts.add(source.truth(), output, patch);
  }
  return counts;
}

}  // namespace redbee::testing
