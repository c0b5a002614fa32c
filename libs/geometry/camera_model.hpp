// Camera models behind one interface: projection of rays in the camera frame C (x right, y down, z forward)
// to raw pixels, and back. A new model is a class and one line in camera_model.cpp.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "redbee/geometry/camera_intrinsics.hpp"

namespace redbee {

/// Points outside the model's domain are refused, never extrapolated.
class CameraModel {
 public:
  virtual ~CameraModel() = default;

  /// Raw pixel of a ray of any length; std::nullopt outside the field of view. `J`, if not null: d pixel / d
  /// ray.
  virtual std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray,
                                                 Eigen::Matrix<double, 2, 3>* J = nullptr) const = 0;
  /// Ray of a raw pixel, of arbitrary length; std::nullopt if no ray in the field of view projects to it.
  virtual std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const = 0;
  /// Opening angle [rad] of the cone about the optical axis in which the model is injective; at most pi for a
  /// model that projects onto a plane.
  virtual double fieldOfView() const = 0;
  /// The camera without distortion that raw images are rectified to.
  virtual CameraIntrinsics idealCamera() const = 0;
  /// True if raw images need no rectification.
  virtual bool isIdeal() const = 0;
};

/// One row of the table of models.
struct CameraModelType {
  std::string name;                  ///< in the configuration, and Kalibr's
  std::vector<std::string> aliases;  ///< in other calibration files
  std::string coefficients;          ///< names in order, separated by blanks
  size_t fewest = 0;                 ///< least number of coefficients, as in Kalibr's files
  size_t most = 0;
  std::unique_ptr<const CameraModel> (*make)(const CameraIntrinsics&) = nullptr;
};

const std::vector<CameraModelType>& cameraModelTypes();
/// By name or alias, ignoring case, '-', '_' and blanks. nullptr if there is none.
const CameraModelType* findCameraModel(const std::string& name);
/// All names, for error messages: "radtan or equidistant".
std::string cameraModelNames();
/// Error message if `count` is not a valid number of coefficients, otherwise empty. 0 is valid: all are zero.
std::string coefficientFault(const CameraModelType& type, size_t count);
/// Throws std::invalid_argument on an unknown model or a wrong number of coefficients.
std::unique_ptr<const CameraModel> makeCameraModel(const CameraIntrinsics& intrinsics);

/// A pinhole camera that covers the raw image up to `max_half_angle` [rad] off the axis in each direction,
/// with the raw image's resolution at the centre. Width and height are multiples of 8 px, so that the image
/// can be halved three times.
CameraIntrinsics coveringPinhole(const CameraModel& model, const CameraIntrinsics& raw,
                                 double max_half_angle);

/// Smallest angle or radius in (0, limit] at which `slope` is no longer positive, otherwise `limit`. Beyond
/// it a distortion polynomial is not injective.
template <typename Slope>
double foldOver(const Slope& slope, double limit) {
  constexpr int kSteps = 512;
  for (int i = 1; i <= kSteps; ++i) {
    if (slope(limit * i / kSteps) > 0) continue;
    double inside = limit * (i - 1) / kSteps, outside = limit * i / kSteps;
    for (int halving = 0; halving < 50; ++halving) {
      const double middle = (inside + outside) / 2;
      (slope(middle) > 0 ? inside : outside) = middle;
    }
    return inside;
  }
  return limit;
}

}  // namespace redbee
