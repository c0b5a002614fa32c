#include "redbee/visual/point_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "redbee/geometry/homography.hpp"
#include "redbee/imaging/pyramid.hpp"
#include "redbee/visual/patch_alignment.hpp"

namespace redbee {
namespace {

/// px: shorter side of the smallest level.
constexpr int kMinSide = 24;
/// Pyramid level (1/8 of the size) at which the whole image is shifted if there is no guess, and the largest
/// shift in its pixels.
constexpr int kShiftLevel = 3;
constexpr int kShiftReach = 8;
/// Least number of grid points with texture; with fewer, the grid is twice as fine.
constexpr int kEnoughPoints = 160;
/// Limits of a point found directly: iterations, and distance from its starting point [px].
constexpr int kQuickIterations = 5;
constexpr double kQuickReachPx = 1.5;

using Template = PatchTemplate<NativeLanes>;

bool isFinite(const Eigen::Vector2d& p) { return p.allFinite(); }

}  // namespace

class PointTracker::Implementation {
 public:
  Implementation(const TrackerParameters& parameters, const cv::Mat1b& unknown)
      : parameters_(parameters), shape_(parameters.window_px), forward_(shape_), backward_(shape_) {
    setUnknown(unknown);
    if (parameters.grid_px < 1 || parameters.levels < 1 || parameters.iterations < 1) {
      throw std::invalid_argument("the tracker's grid, levels and iterations must be positive");
    }
  }

  void setUnknown(const cv::Mat1b& unknown) {
    blocked_.release();
    if (unknown.empty()) return;
    const int side = 2 * (shape_.half + 1) + 1;
    cv::dilate(unknown, blocked_, cv::Mat::ones(side, side, CV_8U));
  }

  Pyramid pyramidOf(const cv::Mat1b& grey) const {
    if (grey.empty()) throw std::invalid_argument("the tracker needs an image");
    return {grey, std::max(parameters_.levels, kShiftLevel + 1), shape_.margin(), kMinSide};
  }

  PointTracks advance(Pyramid image, const std::optional<Eigen::Matrix3d>& guess) {
    current_ = std::move(image);
    PointTracks tracks;
    if (hasPrevious()) tracks = track(guess);
    previous_ = std::move(current_);
    return tracks;
  }

  bool hasTexture(const Pyramid& image, int points) const {
    return hasTexture(image, points, stepFor(image));
  }

  void reset() { previous_.clear(); }

 private:
  bool hasPrevious() const { return !previous_.empty() && previous_[0].size() == current_[0].size(); }

  /// The grid; denser in images of little texture.
  int stepFor(const Pyramid& image) const {
    const int step = parameters_.grid_px;
    return hasTexture(image, kEnoughPoints, step) ? step : std::max(1, step / 2);
  }

  bool hasTexture(const Pyramid& image, int points, int step) const {
    Template patch(shape_);
    int textured = 0;
    forEachGridPoint(image[0], step, [&](int x, int y) {
      if (textured >= points) return;
      textured += patch.texture(image[0], x, y) >= parameters_.min_eigenvalue ? 1 : 0;
    });
    return textured >= points;
  }

  /// Grid points whose patch and gradients lie completely in the known part of the image.
  template <typename Visitor>
  void forEachGridPoint(const PyramidLevel& level, int step, const Visitor& visit) const {
    const int edge = shape_.half + 1;
    for (int y = step / 2; y < level.height - edge; y += step) {
      for (int x = step / 2; x < level.width - edge; x += step) {
        if (x >= edge && y >= edge && !isBlocked(x, y)) visit(x, y);
      }
    }
  }

  PointTracks track(const std::optional<Eigen::Matrix3d>& guess) {
    const Eigen::Vector2d shift = guess ? Eigen::Vector2d::Zero() : coarseShift();
    const Eigen::Vector2d unknown = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    Eigen::Vector2d neighbour = unknown;  // displacement of the previous point
    PointTracks tracks;
    forEachGridPoint(previous_[0], stepFor(previous_), [&](int x, int y) {
      ++tracks.sampled;
      const Eigen::Vector2d start(x, y);
      const Eigen::Vector2d expected = guess ? transfer(*guess, start) : Eigen::Vector2d(start + shift);
      const auto found = follow(x, y, expected, guess.has_value(), neighbour);
      neighbour = found ? Eigen::Vector2d(*found - start) : unknown;
      if (!found) return;
      tracks.previous.emplace_back(static_cast<float>(x), static_cast<float>(y));
      tracks.current.emplace_back(static_cast<float>(found->x()), static_cast<float>(found->y()));
    });
    return tracks;
  }

  Eigen::Vector2d coarseShift() const {
    const int level = std::min(kShiftLevel, previous_.size() - 1);
    const cv::Point shift = bestShift(previous_[level], current_[level], kShiftReach);
    return Eigen::Vector2d(shift.x, shift.y) * (1 << level);
  }

  /// Position of a point near `expected`, which is `predicted` or only an initial guess. A point found
  /// directly at its prediction, with a small residual, needs no backward check.
  std::optional<Eigen::Vector2d> follow(int x, int y, const Eigen::Vector2d& expected, bool predicted,
                                        const Eigen::Vector2d& neighbour) {
    forward_.extract(previous_[0], x, y);
    if (forward_.smallestEigenvalue() < parameters_.min_eigenvalue || !isFinite(expected))
      return std::nullopt;
    Eigen::Vector2d found = expected;
    if (predicted && settlesNear(found)) return found;
    if (isFinite(neighbour)) {
      found = Eigen::Vector2d(x, y) + neighbour;
      if (settlesNear(found) && returns(x, y, found)) return found;
    }
    found = expected;
    if (descend(x, y, found) && isInside(found) && looksAlike(found) && returns(x, y, found)) return found;
    return std::nullopt;
  }

  /// Few, short steps on the image itself: no coarser level is needed.
  bool settlesNear(Eigen::Vector2d& found) const {
    const Eigen::Vector2d start = found;
    const AlignmentLimits limits{kQuickIterations, parameters_.epsilon_px};
    return forward_.align(current_[0], found, limits) == Alignment::kConverged &&
           (found - start).norm() <= kQuickReachPx && isInside(found) && looksAlike(found);
  }

  bool looksAlike(const Eigen::Vector2d& found) const {
    return forward_.residual(current_[0], found) <= parameters_.max_residual;
  }

  /// From the coarsest level to the image; levels on which the patch has no texture or diverges are skipped.
  bool descend(int x, int y, Eigen::Vector2d& found) {
    const Eigen::Vector2d start(x, y);
    const AlignmentLimits limits{parameters_.iterations, parameters_.epsilon_px};
    for (int level = std::min(parameters_.levels, previous_.size()) - 1; level > 0; --level) {
      const double scale = 1 << level;
      const Eigen::Vector2d at = (start / scale).array().round();
      Eigen::Vector2d there = at + (found - start) / scale;
      coarse_.extract(previous_[level], static_cast<int>(at.x()), static_cast<int>(at.y()));
      if (coarse_.smallestEigenvalue() < parameters_.min_eigenvalue) continue;
      if (coarse_.align(current_[level], there, limits) == Alignment::kLost) continue;
      found = start + (there - at) * scale;
    }
    return forward_.align(current_[0], found, limits) != Alignment::kLost;
  }

  /// Forward-backward check. The backward track starts at the whole pixel next to `found`, where the template
  /// needs no interpolation, and must give the same displacement.
  bool returns(int x, int y, const Eigen::Vector2d& found) {
    const Eigen::Vector2d displacement = found - Eigen::Vector2d(x, y);
    const Eigen::Vector2d nearest = found.array().round();
    backward_.extract(current_[0], static_cast<int>(nearest.x()), static_cast<int>(nearest.y()));
    if (backward_.smallestEigenvalue() < parameters_.min_eigenvalue) return false;
    const Eigen::Vector2d expected = nearest - displacement;
    Eigen::Vector2d back = expected;
    const AlignmentLimits limits{parameters_.iterations, parameters_.epsilon_px};
    if (backward_.align(previous_[0], back, limits) == Alignment::kLost) return false;
    return (back - expected).norm() <= parameters_.max_forward_backward_px;
  }

  /// True if the patch lies completely in the current image.
  bool isInside(const Eigen::Vector2d& p) const {
    const double edge = shape_.half + 1;
    return p.x() >= edge && p.y() >= edge && p.x() <= current_[0].width - 1 - edge &&
           p.y() <= current_[0].height - 1 - edge &&
           !isBlocked(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
  }

  bool isBlocked(int x, int y) const {
    return !blocked_.empty() && x < blocked_.cols && y < blocked_.rows && blocked_(y, x) != 0;
  }

  TrackerParameters parameters_;
  PatchShape shape_;
  Template forward_, backward_;
  Template coarse_{shape_};
  Pyramid previous_, current_;
  cv::Mat1b blocked_;  ///< 255 at the centres of patches that touch unknown pixels; may be empty
};

PointTracker::PointTracker(const TrackerParameters& parameters, const cv::Mat1b& unknown)
    : implementation_(std::make_unique<Implementation>(parameters, unknown)) {}
PointTracker::~PointTracker() = default;

Pyramid PointTracker::pyramidOf(const cv::Mat1b& grey) const { return implementation_->pyramidOf(grey); }

PointTracks PointTracker::advance(Pyramid image, const std::optional<Eigen::Matrix3d>& guess) {
  return implementation_->advance(std::move(image), guess);
}

bool PointTracker::hasTexture(const Pyramid& image, int points) const {
  return implementation_->hasTexture(image, points);
}

void PointTracker::setUnknown(const cv::Mat1b& unknown) { implementation_->setUnknown(unknown); }

void PointTracker::reset() { implementation_->reset(); }

}  // namespace redbee
