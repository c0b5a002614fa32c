// An endless flight from a loop of images: trajectory and traffic are periodic, so that images continue
// smoothly and the truth of every frame is known.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/rendered_flight.hpp"

namespace redbee::test {

constexpr int kPeriod_s = 8;  ///< of trajectory and traffic
constexpr int kFps = 24;
constexpr int kLoopFrames = kPeriod_s * kFps;
constexpr int kCarsInLane = 9;

/// A drone swaying over a road. All frequencies are multiples of 1 / kPeriod_s.
inline simulation::Trajectory swaying() {
  constexpr double f = 1.0 / kPeriod_s;
  simulation::TrajectoryParameters p;
  p.position[0] = {0, 0, {{0.8, f, 0.3}, {0.15, 3 * f, 1.0}}};
  p.position[1] = {0, 0, {{1.0, f, 2.0}, {0.2, 2 * f, 0.5}}};
  p.position[2] = {6, 0, {{0.4, f, 4.0}}};
  p.yaw_pitch_roll[0] = {0, 0, {{0.06, f, 1.2}, {0.02, 3 * f, 0.1}}};
  p.yaw_pitch_roll[1] = {0, 0, {{0.03, 2 * f, 0.7}}};
  p.yaw_pitch_roll[2] = {0, 0, {{0.03, 2 * f, 2.9}}};
  return simulation::Trajectory(p);
}

struct Lane {
  double x_m;
  double speed;  ///< m/s along y
  double grey;
};
inline const std::vector<Lane>& lanes() {
  static const std::vector<Lane> all = {{8, 1.6, 50}, {12, -2.2, 170}, {17, 2.6, 60}};
  return all;
}

inline simulation::Scenario endlessScenario() {
  simulation::Scenario s = simulation::groundOnly(7);
  s.trajectory = swaying();
  s.extrinsics.start_height_m =
      simulation::cameraPose(s.trajectory.at(s.extrinsics.timeshift_s), s.extrinsics).p_GC.z();
  s.frames = kLoopFrames;
  s.fps = kFps;
  for (const Lane& lane : lanes()) {
    // Identical cars in a row: after one period each is at the place of the next one.
    for (int i = 0; i < kCarsInLane; ++i) {
      const int from_middle = i - kCarsInLane / 2;
      const double y_m = from_middle * std::abs(lane.speed) * kPeriod_s;
      auto car =
          simulation::lyingPatch(simulation::PatchKind::kMover, lane.x_m, y_m, M_PI / 2, 2.6, 1.3, 0.02,
                                 {simulation::TextureKind::kBody, 11, 0.02, lane.grey, 45, {0.75, 0.7, 1.5}});
      car.motion.velocity = {0, lane.speed, 0};
      s.scene.patches.push_back(car);
    }
  }
  return s;
}

/// Ground truth of one frame.
struct FrameTruth {
  cv::Mat moving;  ///< CV_8U, not 0 on movers
  std::map<int, cv::Rect>
      cars;  ///< boxes of sufficiently visible cars, by a number that is unique over all loops
};

class EndlessFlight {
 public:
  const simulation::Scenario& scenario() const { return loop_.scenario(); }
  const cv::Mat& image(int64_t k) const { return at(k).grey; }
  int64_t utime(int64_t k) const { return scenario().start.count() + k * 1000000 / kFps; }
  int64_t frameAt(int64_t utime) const {
    return ((utime - scenario().start.count()) * kFps + 500000) / 1000000;
  }

  FrameTruth truth(int64_t k) const {
    constexpr int kEnoughPixels = 900;
    FrameTruth truth;
    truth.moving = at(k).mask;
    const int loop = static_cast<int>(k / kLoopFrames);
    for (int id = 1; id <= static_cast<int>(lanes().size()) * kCarsInLane; ++id) {
      const cv::Mat own = at(k).id == id;
      if (cv::countNonZero(own) < kEnoughPixels) continue;
      const int lane = (id - 1) / kCarsInLane;
      const int ahead = lanes()[static_cast<size_t>(lane)].speed > 0 ? 1 : -1;
      truth.cars[1000 * lane + (id - 1) % kCarsInLane - ahead * loop] = cv::boundingRect(own);
    }
    return truth;
  }

 private:
  const simulation::RenderedImage& at(int64_t k) const {
    return loop_.image(static_cast<int>(k % kLoopFrames));
  }

  RenderedFlight loop_{endlessScenario(), kLoopFrames};
};

}  // namespace redbee::test
