#include "redbee/calibration/homography_rotation.hpp"

#include <Eigen/LU>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {

RotationCandidates rotationsFromHomography(const Eigen::Matrix3d& K, const Eigen::Matrix3d& H_ba) {
  Eigen::Matrix3d euclidean = K.inverse() * H_ba * K;
  euclidean /= std::cbrt(euclidean.determinant());

  RotationCandidates candidates;
  candidates.rough = -logSO3(nearestRotation(euclidean));

  cv::Matx33d H;
  cv::eigen2cv(euclidean, H);
  std::vector<cv::Mat> rotations, translations, normals;
  cv::decomposeHomographyMat(H, cv::Matx33d::eye(), rotations, translations, normals);
  constexpr double kSameRotation = 1e-9;  // rad; each comes twice, once with either sign of t and n
  for (const cv::Mat& rotation : rotations) {
    Eigen::Matrix3d R_ba;
    cv::cv2eigen(rotation, R_ba);
    const Eigen::Vector3d vector = -logSO3(nearestRotation(R_ba));
    if (!vector.allFinite()) continue;
    const bool known = !candidates.exact.empty() && (candidates.exact.back() - vector).norm() < kSameRotation;
    if (!known) candidates.exact.push_back(vector);
  }
  if (candidates.exact.empty()) candidates.exact.push_back(candidates.rough);
  return candidates;
}

}  // namespace redbee::calibration
