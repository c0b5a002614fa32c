// Frames of a flight on one map of the ground, by the ground's homographies from frame to frame.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "redbee/geometry/homography.hpp"

namespace redbee {

/// The ground's plane as a frame's camera sees it.
struct GroundPlane {
  Eigen::Vector3d normal;  ///< unit, from the camera towards the ground, camera frame
  double distance_m = 0;
};

/// From ideal pixels to metres on the ground: x to the right of the image, y towards its lower edge, the
/// origin below the camera.
Eigen::Matrix3d groundMap(const Eigen::Matrix3d& K_inverse, const GroundPlane& plane);

/// Chains the steps. Where none leads to a frame from an earlier one, a new piece begins, as nothing says
/// where it lies.
class GroundChain {
 public:
  struct Frame {
    int64_t utime = 0;                 ///< us
    Eigen::Matrix3d H;                 ///< from ideal pixels of the piece's first frame to those of this one
    std::optional<GroundPlane> plane;  ///< as this frame sees it
    double zoom = 1;                   ///< focal length over the camera's
  };

  /// The ground's homography from the frame at `from` to the one at `to`, us.
  void addStep(int64_t from, int64_t to, const Eigen::Matrix3d& H);
  /// Of a frame that a step has led to or from.
  void setPlane(int64_t utime, const GroundPlane& plane);
  void setZoom(int64_t utime, double zoom);

  /// The piece of most frames, in order of time; empty before the first step.
  std::vector<Frame> longestPiece() const;
  /// How many have begun.
  size_t pieces() const { return erased_ + pieces_.size(); }

  /// Of the newest piece; null where no step of it leads to that time.
  const Frame* frame(int64_t utime) const;
  /// The last of the newest piece; null before the first step.
  const Frame* lastFrame() const;
  /// The last of them that has a plane; null where none has.
  const Frame* lastWithPlane() const;
  /// All pieces but the newest, and what it has of earlier times; the next step still goes on from it.
  void eraseBefore(int64_t utime);

 private:
  using Piece = std::map<int64_t, Frame>;
  std::vector<Piece> pieces_;
  size_t erased_ = 0;
};

/// The map that a frame lays: in metres where its plane is known, else in its ideal pixels.
struct MapReference {
  /// `K`: of the ideal camera [px], at the configured focal length.
  MapReference(const GroundChain::Frame& frame, const Eigen::Matrix3d& K);
  /// From the ideal pixels of a frame of the same piece.
  Eigen::Matrix3d toMap(const GroundChain::Frame& frame) const { return own * H * frame.H.inverse(); }
  /// How many times as long, or as short, a length about this ideal pixel of a frame of the same piece is on
  /// the map as by the frame's own plane; 1 is a perfect fit. std::nullopt where either shows no ground
  /// there.
  std::optional<double> misfit(const GroundChain::Frame& frame, const Eigen::Matrix3d& K,
                               const Eigen::Vector2d& pixel) const;
  /// The map of the frame's own plane, so laid that this pixel keeps its place and what is about it its
  /// direction. Precondition: misfit() knows it.
  MapReference relaid(const GroundChain::Frame& frame, const Eigen::Matrix3d& K,
                      const Eigen::Vector2d& pixel) const;

  bool is_metric;
  Eigen::Matrix3d own;  ///< from the ideal pixels of the frame that lays it
  Eigen::Matrix3d H;    ///< of that frame
};

/// A frame's way to the map.
struct MappedFrame {
  int64_t utime = 0;
  Eigen::Matrix3d to_map;  ///< from its ideal pixels
  double zoom = 1;         ///< focal length over the camera's
};

/// The map is that of the plane in the middle of the piece; without any plane that of the middle frame.
struct GroundFrames {
  std::vector<MappedFrame> frames;
  bool is_metric = false;
  Eigen::Matrix3d reference;  ///< to_map of the frame whose plane it is
};
/// `K`: of the ideal camera [px], at the configured focal length.
GroundFrames mapped(const std::vector<GroundChain::Frame>& piece, const Eigen::Matrix3d& K);

}  // namespace redbee
