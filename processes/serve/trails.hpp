// Where the tracked objects were, on the ground as the newest frame shows it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "redbee/detections_t.hpp"
#include "redbee/geometry/camera.hpp"

namespace redbee {

struct Trail {
  int32_t id = 0;
  std::vector<Eigen::Vector2d> points;  ///< px, raw image, oldest first
};

/// A trail's point is the middle of a box's lower edge; it is carried along by the ground's homographies, so
/// that it stays where it is on the ground while the camera moves.
class Trails {
 public:
  static constexpr int64_t kLength_us = 5'000'000;

  explicit Trails(const Camera& camera) : camera_(camera) {}

  /// The ground's homography between ideal pixels of the frames at these times (us). Steps may come before
  /// the detections of their frame.
  void addStep(int64_t from, int64_t to, const Eigen::Matrix3d& H);
  /// The detections of a frame. Trails end where no steps lead here from the frame before, and begin again
  /// where the clock was set back.
  void addDetections(const detections_t& detections);
  /// As the newest frame with detections shows them; points outside of the camera model's domain are left
  /// out.
  std::vector<Trail> trails() const;

 private:
  struct Point {
    int64_t utime;
    Eigen::Vector2d ideal;
  };
  struct Step {
    int64_t from;
    Eigen::Matrix3d H;
  };
  bool carryTo(int64_t utime);

  Camera camera_;
  std::map<int64_t, Step> steps_;  ///< by the time they lead to
  std::map<int32_t, std::deque<Point>> points_;
  int64_t utime_ = 0;  ///< of the frame that the points are in
};

}  // namespace redbee
