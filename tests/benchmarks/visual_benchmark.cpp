// Our tracker against OpenCV's calcOpticalFlowPyrLK on the same images, grid, window, levels and stopping
// rule, one thread.
#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "redbee/simulation/scenarios.hpp"
#include "redbee/visual/homography_estimation.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace {

using namespace redbee;

const std::vector<cv::Mat>& images() {
  static const std::vector<cv::Mat> frames = [] {
    const simulation::FlightSimulator flight(simulation::twoPlanes(1));
    return std::vector<cv::Mat>{flight.frame(1).image.grey, flight.frame(2).image.grey};
  }();
  return frames;
}

/// Pyramid of the new image, forward and backward tracking.
void ourTracker(benchmark::State& state) {
  cv::setNumThreads(1);
  PointTracker tracker({});
  std::size_t k = 0, tracked = 0;
  tracker.advance(images()[0], {});
  for (auto _ : state)
    tracked = tracker.advance(images()[++k % 2], Eigen::Matrix3d::Identity()).previous.size();
  state.counters["tracked"] = static_cast<double>(tracked);
}
BENCHMARK(ourTracker)->Unit(benchmark::kMillisecond);

void openCvTracker(benchmark::State& state) {
  cv::setNumThreads(1);
  const TrackerParameters p;
  const cv::Size window(p.window_px, p.window_px);
  const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, p.iterations, p.epsilon_px);
  std::vector<cv::Point2f> grid;
  for (int y = p.grid_px / 2; y < 480; y += p.grid_px) {
    for (int x = p.grid_px / 2; x < 640; x += p.grid_px) {
      grid.emplace_back(static_cast<float>(x), static_cast<float>(y));
    }
  }
  std::vector<cv::Mat> before, after;
  cv::buildOpticalFlowPyramid(images()[0], before, window, p.levels - 1);
  std::size_t k = 0;
  int tracked = 0;
  for (auto _ : state) {
    cv::buildOpticalFlowPyramid(images()[++k % 2], after, window, p.levels - 1);
    std::vector<cv::Point2f> there = grid, back = grid;
    std::vector<uchar> found, returned;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(before, after, grid, there, found, error, window, p.levels - 1, stop,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    cv::calcOpticalFlowPyrLK(after, before, there, back, returned, error, window, 0, stop,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    tracked = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      tracked += found[i] && returned[i] && cv::norm(back[i] - grid[i]) <= p.max_forward_backward_px ? 1 : 0;
    }
    std::swap(before, after);
  }
  state.counters["tracked"] = tracked;
}
BENCHMARK(openCvTracker)->Unit(benchmark::kMillisecond);

void groundHomography(benchmark::State& state) {
  PointTracker tracker({});
  tracker.advance(images()[0], {});
  const PointTracks tracks = tracker.advance(images()[1], {});
  for (auto _ : state) benchmark::DoNotOptimize(estimateHomography(tracks, 640, 480, {}));
}
BENCHMARK(groundHomography)->Unit(benchmark::kMillisecond);

}  // namespace
