#include "redbee/imaging/warping.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace redbee {

cv::Matx33d toMatx(const Eigen::Matrix3d& H) {
  return {H(0, 0), H(0, 1), H(0, 2), H(1, 0), H(1, 1), H(1, 2), H(2, 0), H(2, 1), H(2, 2)};
}

cv::Mat warpToCurrent(const cv::Mat& map, const cv::Matx33d& H, int interpolation) {
  cv::Mat warped;
  cv::warpPerspective(map, warped, H, map.size(), interpolation, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  return warped;
}

cv::Mat warpToCurrent(const cv::Mat& map, const Eigen::Matrix3d& H, int interpolation) {
  return warpToCurrent(map, toMatx(H), interpolation);
}

cv::Mat1b overlapMask(const cv::Size& size, const cv::Matx33d& H) {
  return warpToCurrent(cv::Mat1b(size, 255), H, cv::INTER_NEAREST);
}

cv::Mat1b overlapMask(const cv::Size& size, const Eigen::Matrix3d& H) { return overlapMask(size, toMatx(H)); }

cv::Mat1b outsidePrevious(const cv::Matx33d& H, cv::Size size) {
  cv::Mat1b outside;
  cv::dilate(overlapMask(size, H) == 0, outside, cv::Mat());
  return outside;
}

bool isUsableHomography(const Eigen::Matrix3d& H) {
  constexpr double kSingular = 1e-9;
  return H.allFinite() && std::abs(H.determinant()) > kSingular;
}

Eigen::Matrix3d downscaling(double downscale) {
  const double shift = -(downscale - 1) / (2 * downscale);
  Eigen::Matrix3d to_small;
  to_small << 1 / downscale, 0, shift, 0, 1 / downscale, shift, 0, 0, 1;
  return to_small;
}

cv::Size shrunkSize(cv::Size full, double downscale) {
  return {cvRound(full.width / downscale), cvRound(full.height / downscale)};
}

SceneMotion::SceneMotion(const Eigen::Matrix3d& ground_homography, const std::optional<PlaneMotion>& motion,
                         const CameraPair& cameras)
    : ground(ground_homography), far(ground_homography), horizon(0, 0, 1) {
  if (!motion) return;
  far = cameras.K_b * motion->R_ba * cameras.K_a.inverse();
  // Ground is where m' R' K_b^-1 x > 0, a linear function of the current pixel x.
  horizon = motion->m_a.transpose() * motion->R_ba.transpose() * cameras.K_b.inverse();
}

SceneMotion::HorizonCut SceneMotion::cutAtHorizon(int y, int width) const {
  const double at_left = horizon.y() * y + horizon.z();
  if (horizon.x() == 0) return {width, at_left > 0};
  const double crossing = std::clamp(std::ceil(-at_left / horizon.x()), 0.0, static_cast<double>(width));
  return {static_cast<int>(crossing), horizon.x() < 0};
}

}  // namespace redbee
