#include "redbee/mosaic/ground_chain.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>

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

const GroundChain::Frame* GroundChain::frame(int64_t utime) const {
  if (pieces_.empty()) return nullptr;
  const auto found = pieces_.back().find(utime);
  return found == pieces_.back().end() ? nullptr : &found->second;
}

const GroundChain::Frame* GroundChain::lastFrame() const {
  return pieces_.empty() ? nullptr : &pieces_.back().rbegin()->second;
}

const GroundChain::Frame* GroundChain::lastWithPlane() const {
  if (pieces_.empty()) return nullptr;
  const Piece& piece = pieces_.back();
  const auto found =
      std::find_if(piece.rbegin(), piece.rend(), [](const auto& entry) { return entry.second.plane; });
  return found == piece.rend() ? nullptr : &found->second;
}

void GroundChain::eraseBefore(int64_t utime) {
  if (pieces_.empty()) return;
  erased_ += pieces_.size() - 1;
  pieces_.erase(pieces_.begin(), pieces_.end() - 1);
  Piece& piece = pieces_.back();
  // The newest stays, so that the next step finds it.
  piece.erase(piece.begin(), piece.lower_bound(std::min(utime, piece.rbegin()->first)));
}

MapReference::MapReference(const GroundChain::Frame& frame, const Eigen::Matrix3d& K)
    : is_metric(frame.plane.has_value()),
      own(is_metric ? groundMap(zoomed(K, frame.zoom).inverse(), *frame.plane) : Eigen::Matrix3d::Identity()),
      H(frame.H) {}

std::optional<double> MapReference::misfit(const GroundChain::Frame& frame, const Eigen::Matrix3d& K,
                                           const Eigen::Vector2d& pixel) const {
  if (!is_metric || !frame.plane) return std::nullopt;
  const MapReference by_own(frame, K);
  const Eigen::Vector3d on_own = by_own.own * pixel.homogeneous();
  const Eigen::Matrix3d from_own = toMap(frame) * by_own.own.inverse();
  const Eigen::Vector3d on_map = from_own * on_own;
  // A projection keeps the sense of rotation where, and only where, both are on one side of the horizon.
  if (!(on_own.z() > 0) || !(std::abs(on_map.z()) > 0)) return std::nullopt;
  const Eigen::Matrix2d J = transferJacobianPoint(from_own, on_own.hnormalized());
  if (!J.allFinite() || !(J.determinant() > 0)) return std::nullopt;
  // Singular values of 2x2 in closed form: their mean and half their difference.
  const double mean = 0.5 * std::hypot(J(0, 0) + J(1, 1), J(1, 0) - J(0, 1));
  const double half = 0.5 * std::hypot(J(0, 0) - J(1, 1), J(1, 0) + J(0, 1));
  return std::max(mean + half, 1 / (mean - half));
}

MapReference MapReference::relaid(const GroundChain::Frame& frame, const Eigen::Matrix3d& K,
                                  const Eigen::Vector2d& pixel) const {
  MapReference result(frame, K);
  const Eigen::Vector2d on_own = transfer(result.own, pixel);
  const Eigen::Matrix3d from_own = toMap(frame) * result.own.inverse();
  const Eigen::Matrix2d J = transferJacobianPoint(from_own, on_own);
  const Eigen::Rotation2Dd turn(std::atan2(J(1, 0) - J(0, 1), J(0, 0) + J(1, 1)));
  Eigen::Matrix3d rigid = Eigen::Matrix3d::Identity();
  rigid.topLeftCorner<2, 2>() = turn.toRotationMatrix();
  rigid.topRightCorner<2, 1>() = transfer(from_own, on_own) - turn * on_own;
  result.own = rigid * result.own;
  return result;
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
  const MapReference map(piece[static_cast<size_t>(reference)], K);
  result.is_metric = map.is_metric;
  result.reference = map.own;
  for (const GroundChain::Frame& other : piece)
    result.frames.push_back({other.utime, map.toMap(other), other.zoom});
  return result;
}

}  // namespace redbee
