#include "redbee/mosaic/ground_chain.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "redbee/geometry/camera.hpp"

namespace redbee {

Eigen::Matrix3d groundMap(const Eigen::Matrix3d& K_inverse, const GroundPlane& plane) {
  const Eigen::Vector3d& m = plane.normal;
  const Eigen::Vector3d right = (Eigen::Vector3d::UnitX() - m.x() * m).normalized();
  Eigen::Matrix3d rays_to_ground;
  rays_to_ground.row(0) = plane.distance_m * right.transpose();
  rays_to_ground.row(1) = plane.distance_m * m.cross(right).transpose();
  rays_to_ground.row(2) = m.transpose();
  return rays_to_ground * K_inverse;
}

void GroundChain::addStep(int64_t from, int64_t to, const Eigen::Matrix3d& H) {
  if (pieces_.empty() || pieces_.back().count(from) == 0) {
    pieces_.emplace_back();
    pieces_.back()[from] = {from, Eigen::Matrix3d::Identity(), std::nullopt, 1};
  }
  Piece& piece = pieces_.back();
  Eigen::Matrix3d composed = H * piece[from].H;
  composed /= composed(2, 2);
  piece[to] = {to, composed, std::nullopt, 1};
}

void GroundChain::setPlane(int64_t utime, const GroundPlane& plane) {
  if (pieces_.empty()) return;
  const auto frame = pieces_.back().find(utime);
  if (frame != pieces_.back().end()) frame->second.plane = plane;
}

void GroundChain::setZoom(int64_t utime, double zoom) {
  if (pieces_.empty()) return;
  const auto frame = pieces_.back().find(utime);
  if (frame != pieces_.back().end()) frame->second.zoom = zoom;
}

std::vector<GroundChain::Frame> GroundChain::longestPiece() const {
  const auto longest = std::max_element(pieces_.begin(), pieces_.end(),
                                        [](const Piece& a, const Piece& b) { return a.size() < b.size(); });
  std::vector<Frame> frames;
  if (longest == pieces_.end()) return frames;
  for (const auto& [utime, frame] : *longest) frames.push_back(frame);
  return frames;
}

GroundFrames mapped(const std::vector<GroundChain::Frame>& piece, const Eigen::Matrix3d& K) {
  GroundFrames result;
  if (piece.empty()) return result;
  // The nearest to the middle that has a plane.
  const auto middle = static_cast<std::ptrdiff_t>(piece.size() / 2);
  std::ptrdiff_t reference = middle;
  std::ptrdiff_t distance = static_cast<std::ptrdiff_t>(piece.size());
  for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(piece.size()); ++k) {
    if (!piece[static_cast<size_t>(k)].plane || std::abs(k - middle) >= distance) continue;
    reference = k;
    distance = std::abs(k - middle);
  }
  const GroundChain::Frame& frame = piece[static_cast<size_t>(reference)];
  result.is_metric = frame.plane.has_value();
  result.reference = result.is_metric ? groundMap(zoomed(K, frame.zoom).inverse(), *frame.plane)
                                      : Eigen::Matrix3d::Identity();
  for (const GroundChain::Frame& other : piece)
    result.frames.push_back({other.utime, result.reference * frame.H * other.H.inverse(), other.zoom});
  return result;
}

}  // namespace redbee
