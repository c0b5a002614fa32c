#include "redbee/detection/parallax/moving_points.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/imaging/resampled.hpp"

namespace redbee {
namespace {

constexpr double kLogLikelihood = 16;
constexpr double kResidual = 3;  // at least, of a normalized residual
// Times the frame's 90 % quantile, which holds what the noise does not: errors of the direction of travel and
// of the registration, and points that slide.
constexpr double kTimesClutter = 2.5;
constexpr double kClutterQuantile = 0.9;
constexpr double kSteady = 0.5;  // of the static fit's residual is left by a steady motion at most

constexpr double kNear_px = 20, kAround_px = 12;  // full size
constexpr int kLeastSupport = 2;
constexpr double kPurity = 0.5;
// Of two velocities that are alike: px per frame at full size, and relative to the velocity.
constexpr double kAlike_px = 0.5, kAlike = 0.4;
constexpr double kPartlyMoving = 0.6;  // of the limits, for a neighbour

constexpr double kReach_px = 10;           // full size
constexpr int kLookAround_px = 2;          // for the greatest difference at a point
constexpr double kShadowDifference = 0.4;  // of which half is a cast shadow's
constexpr double kLeastDifference = 0.05;

struct Limits {
  double log_likelihood, residual;
  bool exceededBy(const PointPath& path) const {
    return path.log_likelihood > log_likelihood && path.static_residual > residual;
  }
};

Limits limitsOf(const std::vector<PointPath>& paths) {
  std::vector<double> residuals;
  residuals.reserve(paths.size());
  for (const PointPath& path : paths) {
    if (path.isTested()) residuals.push_back(path.static_residual);
  }
  if (residuals.empty()) return {kLogLikelihood, kResidual};
  const auto rank = static_cast<std::ptrdiff_t>(kClutterQuantile * static_cast<double>(residuals.size()));
  std::nth_element(residuals.begin(), residuals.begin() + rank, residuals.end());
  return {kLogLikelihood, std::max(kResidual, kTimesClutter * residuals[static_cast<size_t>(rank)])};
}

bool moveAlike(const PointPath& a, const PointPath& b, double scale) {
  return (a.velocity - b.velocity).norm() < kAlike_px / scale + kAlike * a.velocity.norm();
}

/// Weight of a point where the appearance differs by so much.
double notShadow(double difference) { return 1 / (1 + std::pow(kShadowDifference / difference, 4)); }

float greatestAround(const cv::Mat1f& map, const cv::Point& at) {
  const cv::Rect window =
      cv::Rect(at.x - kLookAround_px, at.y - kLookAround_px, 2 * kLookAround_px + 1, 2 * kLookAround_px + 1) &
      cv::Rect({}, map.size());
  double greatest = 0;
  if (!window.empty()) cv::minMaxLoc(map(window), nullptr, &greatest);
  return static_cast<float>(greatest);
}

}  // namespace

std::vector<cv::Point> movingPoints(const std::vector<PointPath>& paths, double scale) {
  const Limits limits = limitsOf(paths);
  const Limits partly{kPartlyMoving * limits.log_likelihood, kPartlyMoving * limits.residual};
  std::vector<const PointPath*> candidates;
  for (const PointPath& path : paths) {
    if (limits.exceededBy(path) && path.moving_residual < kSteady * path.static_residual)
      candidates.push_back(&path);
  }
  std::vector<cv::Point> points;
  for (const PointPath* candidate : candidates) {
    const auto isNear = [&](const PointPath& other, double reach_px) {
      return (other.at - candidate->at).squaredNorm() < std::pow(reach_px / scale, 2);
    };
    const auto support = std::count_if(candidates.begin(), candidates.end(), [&](const PointPath* other) {
      return other != candidate && isNear(*other, kNear_px) && moveAlike(*candidate, *other, scale);
    });
    if (support < kLeastSupport) continue;
    int tested = 0, moving = 0;
    for (const PointPath& other : paths) {
      if (!other.isTested() || !isNear(other, kAround_px)) continue;
      ++tested;
      moving += partly.exceededBy(other) && moveAlike(*candidate, other, scale) ? 1 : 0;
    }
    if (moving >= kPurity * tested)
      points.emplace_back(cvRound(candidate->at.x()), cvRound(candidate->at.y()));
  }
  return points;
}

cv::Mat1f movingRegion(const std::vector<cv::Point>& points, const cv::Mat1f& difference_of_any_size,
                       cv::Size size, double scale) {
  if (points.empty()) return {};
  const cv::Mat1f difference = resized(difference_of_any_size, size);
  cv::Mat1f region = cv::Mat1f::zeros(size);
  const double reach_px = kReach_px / scale;
  const int reach = static_cast<int>(std::ceil(reach_px));
  for (const cv::Point& point : points) {
    const double most = std::max<double>(kLeastDifference, greatestAround(difference, point));
    const double weight = notShadow(most);
    const cv::Rect square = cv::Rect(point.x - reach, point.y - reach, 2 * reach + 1, 2 * reach + 1) &
                            cv::Rect({}, region.size());
    for (int y = square.y; y < square.br().y; ++y) {
      for (int x = square.x; x < square.br().x; ++x) {
        if (cv::norm(cv::Point(x, y) - point) > reach_px) continue;
        const double value = weight * std::min(1.0, difference(y, x) / most);
        region(y, x) = std::max(region(y, x), static_cast<float>(value));
      }
    }
  }
  return region;
}

}  // namespace redbee
