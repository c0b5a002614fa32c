// Camera models behind one interface: rays in the camera frame C (x right, y down, z forward) to raw pixels
// and back. A new model is a class of its own and one line in camera_model.cpp.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "redbee/geometry/camera_intrinsics.hpp"

namespace redbee {

/// What lies outside the model's domain is refused, never extrapolated.
class CameraModel {
 public:
  virtual ~CameraModel() = default;

  /// Raw pixel of a ray of any length; nothing outside the model's field of view. `J`, where given: d pixel /
  /// d ray.
  virtual std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray,
                                                 Eigen::Matrix<double, 2, 3>* J = nullptr) const = 0;
  /// Ray of a raw pixel, its length arbitrary; nothing where no ray of the field of view has that pixel.
  virtual std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const = 0;
  /// Opening angle [rad] of the cone about the optical axis in which the model is one to one; pi at most for
  /// a model that projects onto a plane.
  virtual double fieldOfView() const = 0;
  /// The camera without distortion that raw images are rectified to.
  virtual CameraIntrinsics idealCamera() const = 0;
  /// True where the raw image is already that of idealCamera().
  virtual bool isIdeal() const = 0;
};

/// One row of the table of models.
struct CameraModelType {
  std::string name;                  ///< in the configuration, and Kalibr's
  std::vector<std::string> aliases;  ///< in other calibration files
  std::string coefficients;          ///< their names in order, with blanks in between
  size_t fewest = 0;                 ///< coefficients that have to be given, as Kalibr gives them
  size_t most = 0;
  std::unique_ptr<const CameraModel> (*make)(const CameraIntrinsics&) = nullptr;
};

const std::vector<CameraModelType>& cameraModelTypes();
/// By name or alias; letter case, '-', '_' and blanks do not matter. Null where there is none.
const CameraModelType* findCameraModel(const std::string& name);
/// The names, for messages: "radtan or equidistant".
std::string cameraModelNames();
/// What is wrong with the number of coefficients; empty where nothing is. None at all means that all are
/// zero.
std::string coefficientFault(const CameraModelType& type, size_t count);
/// Throws std::invalid_argument on an unknown model or a wrong number of coefficients.
std::unique_ptr<const CameraModel> makeCameraModel(const CameraIntrinsics& intrinsics);

/// The pinhole camera with the raw image's resolution at its centre that covers the raw image, up to
/// `max_half_angle` [rad] to either side of the axis, left, right, up and down. Its sides are multiples of 8
/// px, so that the image can be halved three times.
CameraIntrinsics coveringPinhole(const CameraModel& model, const CameraIntrinsics& raw,
                                 double max_half_angle);

/// Smallest angle or radius in (0, limit] at which `slope` is no longer positive; `limit` where there is
/// none. Beyond it a distortion polynomial folds over.
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
