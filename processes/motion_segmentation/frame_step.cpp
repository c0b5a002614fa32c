#include "processes/motion_segmentation/frame_step.hpp"

#include <Eigen/LU>
#include <utility>

#include "processes/conversions.hpp"
#include "redbee/geometry/compose_motion.hpp"

namespace redbee {
namespace {

Eigen::Vector2d vectorOf(const cv::Point2f& point) { return {point.x, point.y}; }

PointTracks takenBack(const FrameStep& before, const FrameStep& last) {
  PointTracks tracks = last.tracks;
  const bool has_front = before.front && last.front;
  const Eigen::Matrix3d ground_back = before.ground.inverse();
  const Eigen::Matrix3d front_back = has_front ? Eigen::Matrix3d(before.front->inverse()) : ground_back;
  for (size_t i = 0; i < tracks.previous.size(); ++i) {
    const Eigen::Vector2d from = vectorOf(tracks.previous[i]);
    const Eigen::Vector2d to = vectorOf(tracks.current[i]);
    const bool is_front =
        has_front && (transfer(*last.front, from) - to).norm() < (transfer(last.ground, from) - to).norm();
    const Eigen::Vector2d start = transfer(is_front ? front_back : ground_back, from);
    tracks.previous[i] = {static_cast<float>(start.x()), static_cast<float>(start.y())};
  }
  return tracks;
}

}  // namespace

FrameStep composed(const FrameStep& before, FrameStep last) {
  last.tracks = takenBack(before, last);
  last.ground = normaliseHomography(last.ground * before.ground);
  last.front = composeHomographies(last.front, before.front);
  last.motion = compose(last.motion, before.motion);
  return last;
}

std::optional<FrameStep> stepAlong(const MessageSynchronizer<fused_homography_t>& messages, CameraTime from,
                                   CameraTime to) {
  const fused_homography_t* message = messages.find(to);
  if (message == nullptr || message->source == fused_homography_t::NONE) return std::nullopt;
  const CameraTime previous = previousTimeOf(*message);
  FrameStep step{matrix3(message->step.H), {}, {}, {}};
  if (message->has_motion != 0) step.motion = motionOf(message->motion);
  const auto addTracked = [&](FrameStep& of) {
    of.tracks = tracksOf(message->tracks);
    if (message->has_front != 0) of.front = matrix3(message->H_front);
  };
  const CameraTime tracked_from{fromUtime(message->utime_tracks)};
  if (tracked_from == previous) addTracked(step);
  if (previous == from) return step;
  if (previous < from || previous >= to) return std::nullopt;
  const std::optional<FrameStep> before = stepAlong(messages, from, previous);
  if (!before) return std::nullopt;
  FrameStep whole = composed(*before, std::move(step));
  if (tracked_from == from) addTracked(whole);
  return whole;
}

}  // namespace redbee
