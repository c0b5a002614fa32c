#include "redbee/geometry/camera_model.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "redbee/geometry/equidistant_model.hpp"
#include "redbee/geometry/radtan_model.hpp"

namespace redbee {
namespace {

template <typename Model>
std::unique_ptr<const CameraModel> make(const CameraIntrinsics& intrinsics) {
  return std::make_unique<Model>(intrinsics);
}

/// Lower case, letters and digits only.
std::string plain(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0) text += static_cast<char>(std::tolower(byte));
  }
  return text;
}

/// Slope x / z of the ray of `pixel` along `axis`, limited; the limit if the pixel has no ray in front of the
/// camera.
double limitedSlope(const CameraModel& model, const Eigen::Vector2d& pixel, int axis, double limit) {
  const auto ray = model.unproject(pixel);
  if (!ray || ray->z() <= 0) return limit;
  return std::min(std::abs((*ray)(axis)) / ray->z(), limit);
}

int roundedUp(double side) {
  constexpr int kMultiple = 8;
  return kMultiple * static_cast<int>(std::ceil(side / kMultiple));
}

}  // namespace

const std::vector<CameraModelType>& cameraModelTypes() {
  static const std::vector<CameraModelType> types{
      {"radtan",
       {"radial-tangential", "plumb_bob", "brown-conrady"},
       "k1 k2 p1 p2 k3",
       4,
       5,
       make<RadtanModel>},
      {"equidistant",
       {"equi", "kannala-brandt", "kannala-brandt4", "fisheye"},
       "k1 k2 k3 k4",
       4,
       4,
       make<EquidistantModel>},
  };
  return types;
}

const CameraModelType* findCameraModel(const std::string& name) {
  for (const CameraModelType& type : cameraModelTypes()) {
    const auto isName = [&](const std::string& other) { return plain(other) == plain(name); };
    if (isName(type.name) || std::any_of(type.aliases.begin(), type.aliases.end(), isName)) return &type;
  }
  return nullptr;
}

std::string cameraModelNames() {
  std::string names;
  for (const CameraModelType& type : cameraModelTypes()) names += (names.empty() ? "" : " or ") + type.name;
  return names;
}

std::string coefficientFault(const CameraModelType& type, size_t count) {
  if (count == 0 || (count >= type.fewest && count <= type.most)) return "";
  std::string wanted = std::to_string(type.fewest);
  if (type.most > type.fewest) wanted += " or " + std::to_string(type.most);
  return "must be " + wanted + " coefficients for " + type.name + " (" + type.coefficients + "), has " +
         std::to_string(count);
}

std::unique_ptr<const CameraModel> makeCameraModel(const CameraIntrinsics& intrinsics) {
  const CameraModelType* type = findCameraModel(intrinsics.model);
  if (type == nullptr) throw std::invalid_argument("no camera model " + intrinsics.model);
  if (intrinsics.distortion.empty()) {
    CameraIntrinsics undistorted = intrinsics;
    undistorted.distortion.assign(type->fewest, 0.0);
    return type->make(undistorted);
  }
  const std::string fault = coefficientFault(*type, intrinsics.distortion.size());
  if (!fault.empty()) throw std::invalid_argument(fault);
  return type->make(intrinsics);
}

CameraIntrinsics coveringPinhole(const CameraModel& model, const CameraIntrinsics& raw,
                                 double max_half_angle) {
  const double limit = std::tan(max_half_angle);
  const double left = raw.fx * limitedSlope(model, {-0.5, raw.cy}, 0, limit);
  const double right = raw.fx * limitedSlope(model, {raw.width - 0.5, raw.cy}, 0, limit);
  const double up = raw.fy * limitedSlope(model, {raw.cx, -0.5}, 1, limit);
  const double down = raw.fy * limitedSlope(model, {raw.cx, raw.height - 0.5}, 1, limit);
  CameraIntrinsics ideal;
  ideal.width = roundedUp(left + right);
  ideal.height = roundedUp(up + down);
  ideal.fx = raw.fx;
  ideal.fy = raw.fy;
  ideal.cx = left - 0.5 + (ideal.width - left - right) / 2;
  ideal.cy = up - 0.5 + (ideal.height - up - down) / 2;
  return ideal;
}

}  // namespace redbee
