#include "redbee/detection/rivals/registration.hpp"

#include <opencv2/calib3d.hpp>

namespace redbee {
namespace {

// Random matches give far fewer inliers; water and foliage leave only a few more on one plane.
constexpr double kMinInlierRatio = 0.03;
constexpr size_t kMinInliers = 8;

/// Homographies that mirror or collapse the image are not camera motions.
bool isCameraMotion(const cv::Matx33d& H) {
  constexpr double kMostMagnification = 4.0;
  const double area = H(0, 0) * H(1, 1) - H(0, 1) * H(1, 0);
  return area > 1 / kMostMagnification && area < kMostMagnification;
}

}  // namespace

std::optional<cv::Matx33d> registerTracks(const GridTracks& tracks, double inlier_px) {
  const auto enough =
      kMinInliers + static_cast<size_t>(kMinInlierRatio * static_cast<double>(tracks.sampled));
  if (tracks.previous.size() < enough) return std::nullopt;
  std::vector<uint8_t> inlier;
  const cv::Mat found = cv::findHomography(tracks.previous, tracks.current, cv::RANSAC, inlier_px, inlier);
  if (found.empty() || !cv::checkRange(found)) return std::nullopt;
  const cv::Matx33d H = found;
  if (static_cast<size_t>(cv::countNonZero(inlier)) < enough || !isCameraMotion(H)) return std::nullopt;
  return H;
}

}  // namespace redbee
