#include "redbee/detection/objects/static_path.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>

#include "redbee/geometry/compose_motion.hpp"

namespace redbee {
namespace {

constexpr double kSpan_s = 1.5;
constexpr size_t kFewestPoints = 4;
constexpr double kWeakPrior = 1e-9;            // keeps a fit regular where nothing observes an unknown
constexpr double kLeastDirectionError = 1e-6;  // rad; 0 is allowed, and its weight is not a number
// What a component shows of its object changes slowly: errors that are as far apart are independent.
constexpr double kCorrelation_s = 0.17;

/// Weighted least squares of `Unknowns` parameters, with a weak prior on each.
template <int Unknowns>
class LeastSquares {
 public:
  using Vector = Eigen::Matrix<double, Unknowns, 1>;
  using Rows = Eigen::Matrix<double, 2, Unknowns>;

  void add(const Rows& A, const Eigen::Vector2d& b, const Eigen::Matrix2d& whitening) {
    const Rows white = whitening * A;
    const Eigen::Vector2d measured = whitening * b;
    normal_.noalias() += white.transpose() * white;
    right_.noalias() += white.transpose() * measured;
    total_ += measured.squaredNorm();
  }
  void addPrior(int unknown, double weight) { normal_(unknown, unknown) += weight; }
  Vector solve() const { return normal_.ldlt().solve(right_); }
  double chiSquare() const { return std::max(0.0, total_ - right_.dot(solve())); }

 private:
  Eigen::Matrix<double, Unknowns, Unknowns> normal_ =
      kWeakPrior * Eigen::Matrix<double, Unknowns, Unknowns>::Identity();
  Vector right_ = Vector::Zero();
  double total_ = 0;
};

/// The base of a moving point lies behind by its velocity times the age.
double chiSquareOfMoving(const std::vector<PathObservation>& observations) {
  LeastSquares<4> fit;
  for (const auto& [seen, whitening] : observations) {
    Eigen::Matrix<double, 2, 4> A;
    A << Eigen::Matrix2d::Identity(), -seen.age_s * Eigen::Matrix2d::Identity();
    fit.add(A, seen.base, whitening);
  }
  return fit.chiSquare();
}

/// Depth, 0 (ground) to 1 (nearest), of the static point that fits best.
double bestDepth(const std::vector<PathObservation>& observations) {
  LeastSquares<3> fit;
  for (const auto& [seen, whitening] : observations) {
    Eigen::Matrix<double, 2, 3> A;
    A << Eigen::Matrix2d::Identity(), -seen.parallax;
    fit.add(A, seen.base, whitening);
  }
  return std::clamp(fit.solve()(2), 0.0, 1.0);
}

/// The direction of the parallax may be off by a small angle, the same for all frames.
double chiSquareOfStatic(const std::vector<PathObservation>& observations, double direction_error) {
  const double depth = bestDepth(observations);
  LeastSquares<3> fit;
  for (const auto& [seen, whitening] : observations) {
    const Eigen::Vector2d parallax = depth * seen.parallax;
    Eigen::Matrix<double, 2, 3> A;
    A << Eigen::Matrix2d::Identity(), Eigen::Vector2d(parallax.y(), -parallax.x());
    fit.add(A, seen.base + parallax, whitening);
  }
  const double sigma = std::max(direction_error, kLeastDirectionError);
  fit.addPrior(2, 1 / (sigma * sigma));
  return fit.chiSquare();
}

}  // namespace

void CameraPath::propagate(double elapsed_s, const std::optional<Eigen::Matrix3d>& ground,
                           const std::optional<CameraStep>& step) {
  ++current_;
  if (!ground || !step) {
    frames_.clear();
    return;
  }
  const Eigen::Matrix3d& K_now = step->cameras.K_b;
  const auto frameOf = [&](double age_s, const Eigen::Matrix3d& H, const PlaneMotion& motion,
                           const Eigen::Matrix3d& K) {
    const Eigen::Vector3d epipole = K_now * motion.t_ba / (nearest_depth_fraction_ * motion.h_a);
    return Frame{age_s, SceneMotion(H, motion, {K, K_now}), motion, K, epipole};
  };
  for (Frame& frame : frames_) {
    frame = frameOf(frame.age_s + elapsed_s, normaliseHomography(*ground * frame.scene.ground),
                    compose(step->motion, frame.motion), frame.K);
  }
  frames_.push_back(frameOf(elapsed_s, *ground, step->motion, step->cameras.K_a));
  while (!frames_.empty() && frames_.front().age_s > kSpan_s) frames_.pop_front();
}

bool CameraPath::remembers(int64_t frame) const { return oldest() <= frame && frame <= current_; }

CameraPath::Sighting CameraPath::project(int64_t frame, const Eigen::Vector2d& pixel) const {
  if (frame == current_) return {0, pixel, Eigen::Vector2d::Zero()};
  const Frame& from = frames_[static_cast<size_t>(frame - oldest())];
  const Eigen::Vector3d far = from.scene.far * pixel.homogeneous();
  const bool shows_ground = from.scene.horizon.dot(far) > 0;
  Sighting seen;
  seen.age_s = from.age_s;
  seen.base = shows_ground ? transfer(from.scene.ground, pixel) : Eigen::Vector2d(far.hnormalized());
  seen.parallax = from.epipole.head<2>() - from.epipole.z() * seen.base;
  return seen;
}

PathFit fitPath(const std::vector<PathObservation>& observations, double direction_error) {
  return {chiSquareOfStatic(observations, direction_error), chiSquareOfMoving(observations)};
}

void UniformPathFit::add(const CameraPath::Sighting& seen) {
  ++count_;
  age_ += seen.age_s;
  age_age_ += seen.age_s * seen.age_s;
  base_ += seen.base;
  parallax_ += seen.parallax;
  age_base_ += seen.age_s * seen.base;
  base_base_ += seen.base * seen.base.transpose();
  parallax_base_ += seen.parallax * seen.base.transpose();
  parallax_parallax_ += seen.parallax * seen.parallax.transpose();
}

/// The position is eliminated by sums about the means; what remains of each fit has one unknown, or two equal
/// ones.
PathFit UniformPathFit::solve(const Eigen::Matrix2d& whitening, double direction_error) const {
  const Eigen::Matrix2d weight = whitening.transpose() * whitening;
  const auto number = static_cast<double>(count_);
  const auto weighted = [&](const Eigen::Matrix2d& products) { return weight.cwiseProduct(products).sum(); };
  const Eigen::Matrix2d base_base = base_base_ - base_ * base_.transpose() / number;
  const Eigen::Matrix2d parallax_base = parallax_base_ - parallax_ * base_.transpose() / number;
  const Eigen::Matrix2d parallax_parallax = parallax_parallax_ - parallax_ * parallax_.transpose() / number;
  const double total = weighted(base_base);

  const double age_age = age_age_ - age_ * age_ / number + kWeakPrior;
  const Eigen::Vector2d age_base = age_base_ - age_ * base_ / number;
  const double moving = total - age_base.dot(weight * age_base) / age_age;

  const double along = weighted(parallax_base), length2 = weighted(parallax_parallax);
  const double depth = std::clamp(-along / (length2 + kWeakPrior), 0.0, 1.0);
  Eigen::Matrix2d turn;  // of the parallax by a right angle
  turn << 0, 1, -1, 0;
  const double across = depth * (weighted(turn * parallax_base) + depth * weighted(turn * parallax_parallax));
  const double across2 = depth * depth * weighted(turn * parallax_parallax * turn.transpose());
  const double sigma = std::max(direction_error, kLeastDirectionError);
  const double at_rest = total + 2 * depth * along + depth * depth * length2;
  const double rest = at_rest - across * across / (across2 + 1 / (sigma * sigma));
  return {std::max(0.0, rest), std::max(0.0, moving)};
}

std::optional<double> movingLogLikelihood(const std::deque<PathPoint>& points, const CameraPath& camera,
                                          double direction_error) {
  std::vector<PathObservation> observations;
  for (const PathPoint& point : points) {
    if (!camera.remembers(point.frame)) continue;
    CameraPath::Sighting seen = camera.project(point.frame, point.centre_px);
    seen.base -= points.back().centre_px;  // small numbers
    observations.push_back({seen, point.variance_px2.cwiseInverse().cwiseSqrt().asDiagonal()});
  }
  if (observations.size() < kFewestPoints) return std::nullopt;
  const double span_s = observations.front().seen.age_s - observations.back().seen.age_s;
  const auto gaps = static_cast<double>(observations.size() - 1);
  const double correlated = std::max(1.0, kCorrelation_s * gaps / span_s);
  const PathFit fit = fitPath(observations, direction_error);
  return 0.5 * (fit.static_chi2 - fit.moving_chi2) / correlated;
}

}  // namespace redbee
