// The segmentation's stages and the whole, a 640x480 simulated flight, one thread.
#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "redbee/detection/appearance/appearance_model.hpp"
#include "redbee/detection/detector.hpp"
#include "redbee/detection/objects/object_tracker.hpp"
#include "redbee/detection/parallax/earlier_frames.hpp"
#include "redbee/detection/parallax/parallax_evidence.hpp"
#include "redbee/detection/two_planes/two_plane_background.hpp"
#include "redbee/imaging/guided_filter.hpp"
#include "redbee/simulation/scenarios.hpp"
#include "tests/support/detector_flight.hpp"

namespace {

using namespace redbee;

constexpr int kFrames = 30;

const std::vector<FrameInput>& inputs() {
  static const test::DetectorFlight flight(simulation::twoPlanes(1), kFrames, simulation::kFacadePatch);
  cv::setNumThreads(1);
  return flight.inputs;
}

/// The detector restarts at the end of the loop, so one frame in thirty is cheaper than the others.
void wholeStep(benchmark::State& state, const DetectionParameters& parameters) {
  inputs();
  const auto detector = makeDetector(parameters);
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(detector->step(inputs()[k++ % kFrames]));
}

void defaultFullSize(benchmark::State& state) {
  DetectionParameters parameters;
  parameters.parallax.work_downscale = 1;
  parameters.appearance.downscale = 1;
  parameters.parallax.flow_downscale = 1;
  wholeStep(state, parameters);
}
void sharpBackground(benchmark::State& state) {
  DetectionParameters parameters;
  parameters.appearance.downscale = 1;
  wholeStep(state, parameters);
}
void defaultPreset(benchmark::State& state) { wholeStep(state, {}); }
void defaultQuarterSize(benchmark::State& state) {
  DetectionParameters parameters;
  parameters.parallax.work_downscale = 4;
  wholeStep(state, parameters);
}
void paperPreset(benchmark::State& state) { wholeStep(state, paperDetection()); }
BENCHMARK(defaultPreset)->Unit(benchmark::kMillisecond);
BENCHMARK(sharpBackground)->Unit(benchmark::kMillisecond);
BENCHMARK(defaultFullSize)->Unit(benchmark::kMillisecond);
BENCHMARK(defaultQuarterSize)->Unit(benchmark::kMillisecond);
BENCHMARK(paperPreset)->Unit(benchmark::kMillisecond);

cv::Mat halfSize(const cv::Mat& grey) {
  cv::Mat half;
  cv::resize(grey, half, {}, 0.5, 0.5, cv::INTER_AREA);
  return half;
}

void alignHalfSize(benchmark::State& state) {
  EarlierFrame frame;
  frame.grey = halfSize(inputs()[0].grey);
  frame.ground(0, 2) = 1.3;
  for (auto _ : state) benchmark::DoNotOptimize(alignImage(frame, inputs()[0].K, 8));
}
BENCHMARK(alignHalfSize)->Unit(benchmark::kMillisecond);

void appearanceModel(benchmark::State& state) {
  cv::Mat colour, moving = cv::Mat::zeros(inputs()[0].grey.size(), CV_32F);
  cv::cvtColor(inputs()[0].grey, colour, cv::COLOR_GRAY2BGRA);
  const SurfaceSpeed speed(colour.size(), cv::Vec2f(0, 0.1F));
  SpareMaps spare;
  AppearanceModel background{{}, {}, ParallaxParameters{}.evidence_sigmas};
  background.learn(colour, moving, speed, 0.04);
  const SceneMotion scene(*inputs()[1].ground, inputs()[1].motion, inputs()[1].K);
  for (auto _ : state) {
    background.propagate(scene, spare);
    benchmark::DoNotOptimize(background.appearanceDifference(colour, speed));
    background.learn(colour, moving, speed, 0.04);
  }
}
BENCHMARK(appearanceModel)->Unit(benchmark::kMillisecond);

void guidedFilterHalfSize(benchmark::State& state) {
  const cv::Mat grey = halfSize(inputs()[0].grey);
  const cv::Mat map(grey.size(), CV_32F, cv::Scalar(0.5));
  for (auto _ : state) benchmark::DoNotOptimize(guidedFilter(grey, map, 4, 12));
}
BENCHMARK(guidedFilterHalfSize)->Unit(benchmark::kMillisecond);

void denseFlowHalfSize(benchmark::State& state) {
  const cv::Mat then = halfSize(inputs()[0].grey), now = halfSize(inputs()[3].grey);
  InverseSearch search = makeMotionFlow({});
  for (auto _ : state) benchmark::DoNotOptimize(search.flow(now, then));
}
BENCHMARK(denseFlowHalfSize)->Unit(benchmark::kMillisecond);

void travelHalfSize(benchmark::State& state) {
  const cv::Size half(320, 240);
  const cv::Mat2f residual(1, half.width, cv::Vec2f(1, 0));
  const FrameEvidence now{[&](int) { return residual[0]; }, cv::Mat2f(half, cv::Vec2f(0.5F, 0))};
  SpareMaps spare;
  PropagatedEvidence evidence{{}};
  const cv::Mat unknown = cv::Mat::zeros(half, CV_8U);
  for (auto _ : state) {
    evidence.update(now, Eigen::Matrix3d::Identity(), unknown, spare);
    benchmark::DoNotOptimize(evidence.motion());
  }
}
BENCHMARK(travelHalfSize)->Unit(benchmark::kMillisecond);

void components(benchmark::State& state) {
  cv::Mat probability = cv::Mat::zeros(480, 640, CV_8U);
  for (int i = 0; i < 20; ++i) probability(cv::Rect(30 * i, 20 * i, 12, 25)).setTo(230);
  const cv::Mat unknown = cv::Mat::zeros(480, 640, CV_8U);
  for (auto _ : state) benchmark::DoNotOptimize(findComponents(probability, unknown, {}));
}
BENCHMARK(components)->Unit(benchmark::kMillisecond);

void trackTwentyObjects(benchmark::State& state) {
  cv::Mat1b probability = cv::Mat1b::zeros(480, 640);
  for (int i = 0; i < 20; ++i) probability(cv::Rect(30 * i, 20 * i, 12, 25)).setTo(230);
  ForegroundComponents found = findComponents(probability, cv::Mat1b::zeros(480, 640), {});
  ObjectTracker tracker{ObjectParameters{}};
  const Eigen::Matrix3d ground = Eigen::Matrix3d::Identity();
  for (auto _ : state) {
    tracker.propagate(std::chrono::milliseconds(40), ground);
    benchmark::DoNotOptimize(tracker.update(found));
  }
}
BENCHMARK(trackTwentyObjects)->Unit(benchmark::kMillisecond);

void twoPlaneBackground(benchmark::State& state) {
  TwoPlaneBackground background{{}, paperDetection().learning_frames};
  background.learn(inputs()[0].grey);
  std::size_t k = 0;
  for (auto _ : state) {
    const FrameInput& input = inputs()[1 + k++ % (kFrames - 1)];
    background.propagate(*input.ground, input.front);
    benchmark::DoNotOptimize(background.learn(input.grey));
  }
}
BENCHMARK(twoPlaneBackground)->Unit(benchmark::kMillisecond);

}  // namespace
