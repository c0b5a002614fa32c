#include "redbee/importers/sensor_yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/geometry/camera_model.hpp"

namespace redbee {
namespace {

/// More than any model has; how many it takes is for the model to decide.
constexpr size_t kManyCoefficients = 64;

/// One parsed file; every access throws with file and line.
class SensorFile {
 public:
  /// `section`: the key that holds the keys; empty for those of the file itself. `is_optional`: also where
  /// there is no such section.
  explicit SensorFile(const std::filesystem::path& file, const std::string& section = "",
                      bool is_optional = false)
      : file_(file) {
    requireFile(file);
    std::ifstream in(file);
    if (!in) throw InputError(file, "cannot be read");
    std::string text;
    for (std::string line; std::getline(in, line);) {
      // OpenCV's directive is no YAML; an empty line in its place keeps the line numbers.
      text += (line.rfind("%YAML", 0) == 0 ? "" : line) + "\n";
    }
    try {
      root_ = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      throw InputError(file, error.mark.line + 1, error.msg);
    }
    if (!section.empty() && (!is_optional || hasKey(section))) root_ = sectionOf(root_, section);
    if (!root_.IsMap()) throw InputError(file, 1, "holds no keys");
  }

  bool has(const char* key) const { return root_[key].IsDefined(); }

  template <typename Value>
  Value get(const char* key) const {
    const YAML::Node node = root_[key];
    if (!node.IsDefined()) throw InputError(file_, std::string("key '") + key + "' is missing");
    return convert<Value>(node, key);
  }

  double positive(const char* key) const {
    const double value = get<double>(key);
    if (!std::isfinite(value) || value <= 0) fail(key, "must be a positive number");
    return value;
  }

  std::optional<SensorPose> pose(const char* key = "T_BS") const {
    if (!has(key)) return std::nullopt;
    const YAML::Node node = root_[key];
    const auto data = convert<std::vector<double>>(node.IsMap() ? node["data"] : inOneList(node), key);
    if (data.size() != 16) fail(key, "must have 16 numbers, has " + std::to_string(data.size()));
    for (const double number : data) {
      if (!std::isfinite(number)) fail(key, "holds a number that is not finite");
    }
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> T_BS(data.data());
    if ((T_BS.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() > 1e-6)
      fail(key, "its last row is not 0 0 0 1");
    const Eigen::Matrix3d R = T_BS.topLeftCorner<3, 3>();
    // Files print few digits; what is a rotation up to that is made an exact one.
    if ((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() > 1e-2 || R.determinant() < 0) {
      fail(key, "its rotation is not one");
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return SensorPose{svd.matrixU() * svd.matrixV().transpose(), T_BS.topRightCorner<3, 1>()};
  }

  [[noreturn]] void fail(const char* key, const std::string& what) const {
    throw InputError(file_, root_[key].Mark().line + 1, std::string(key) + ": " + what);
  }

 private:
  bool hasKey(const std::string& key) const { return root_.IsMap() && root_[key].IsDefined(); }

  YAML::Node sectionOf(const YAML::Node& root, const std::string& section) const {
    if (!root.IsMap() || !root[section].IsDefined())
      throw InputError(file_, "holds no '" + section + "': is it a camchain?");
    return root[section];
  }

  /// Kalibr writes a matrix as a list of rows.
  static YAML::Node inOneList(const YAML::Node& node) {
    if (!node.IsSequence() || node.size() == 0 || !node[0].IsSequence()) return node;
    YAML::Node list;
    for (const auto& row : node) {
      for (const auto& number : row) list.push_back(number);
    }
    return list;
  }

  template <typename Value>
  Value convert(const YAML::Node& node, const char* key) const {
    try {
      return node.as<Value>();
    } catch (const YAML::Exception&) {
      fail(key, "has the wrong type");
    }
  }

  std::filesystem::path file_;
  YAML::Node root_;
};

std::vector<double> finiteNumbers(const SensorFile& file, const char* key, size_t least, size_t most) {
  auto numbers = file.get<std::vector<double>>(key);
  if (numbers.size() < least || numbers.size() > most) {
    file.fail(key, "has " + std::to_string(numbers.size()) + " numbers");
  }
  for (const double number : numbers) {
    if (!std::isfinite(number)) file.fail(key, "holds a number that is not finite");
  }
  return numbers;
}

/// Intrinsics under ASL's or Kalibr's name of the coefficients' key.
CameraIntrinsics cameraIntrinsics(const SensorFile& file, const char* coefficients_key) {
  const auto model =
      file.has("camera_model") ? file.get<std::string>("camera_model") : std::string("pinhole");
  if (model != "pinhole") file.fail("camera_model", "'" + model + "' is not supported, only pinhole");

  CameraIntrinsics camera;
  const auto resolution = finiteNumbers(file, "resolution", 2, 2);
  const auto intrinsics = finiteNumbers(file, "intrinsics", 4, 4);
  if (resolution[0] < 1 || resolution[1] < 1) file.fail("resolution", "must be positive");
  if (intrinsics[0] <= 0 || intrinsics[1] <= 0) file.fail("intrinsics", "focal lengths must be positive");
  camera.width = static_cast<int>(resolution[0]);
  camera.height = static_cast<int>(resolution[1]);
  camera.fx = intrinsics[0];
  camera.fy = intrinsics[1];
  camera.cx = intrinsics[2];
  camera.cy = intrinsics[3];
  if (file.has("line_delay_s")) {
    constexpr double kMost_s = 1e-3;
    camera.line_delay_s = file.get<double>("line_delay_s");
    if (!(std::abs(camera.line_delay_s) <= kMost_s))
      file.fail("line_delay_s", "must lie from -0.001 to 0.001: the read-out time over the number of rows");
  }
  const auto name =
      file.has("distortion_model") ? file.get<std::string>("distortion_model") : std::string("radtan");
  if (name == "none" || !file.has(coefficients_key)) return camera;
  const CameraModelType* type = findCameraModel(name);
  if (type == nullptr)
    file.fail("distortion_model", "'" + name + "' is not supported, only " + cameraModelNames());
  camera.model = type->name;
  camera.distortion = finiteNumbers(file, coefficients_key, 0, kManyCoefficients);
  const std::string fault = coefficientFault(*type, camera.distortion.size());
  if (!fault.empty()) file.fail(coefficients_key, fault);
  return camera;
}

ImuNoise imuNoise(const SensorFile& file) {
  ImuNoise noise;
  noise.gyro_noise_density = file.positive("gyroscope_noise_density");
  noise.accel_noise_density = file.positive("accelerometer_noise_density");
  noise.gyro_random_walk = file.positive("gyroscope_random_walk");
  noise.accel_random_walk = file.positive("accelerometer_random_walk");
  return noise;
}

}  // namespace

CameraSensor readCameraSensor(const std::filesystem::path& path) {
  const SensorFile file(path);
  return {cameraIntrinsics(file, "distortion_coefficients"), file.pose()};
}

CamchainCamera readCamchain(const std::filesystem::path& path, const std::string& name) {
  const SensorFile file(path, name);
  CamchainCamera camera;
  camera.intrinsics = cameraIntrinsics(file, "distortion_coeffs");
  if (const auto T_CI = file.pose("T_cam_imu")) {
    camera.R_CI = T_CI->R_BS;
    camera.p_IC = -T_CI->R_BS.transpose() * T_CI->p_BS;
  } else if (const auto T_IC = file.pose("T_imu_cam")) {  // as OpenVINS has it
    camera.R_CI = T_IC->R_BS.transpose();
    camera.p_IC = T_IC->p_BS;
  }
  if (file.has("timeshift_cam_imu")) camera.timeshift_s = file.get<double>("timeshift_cam_imu");
  return camera;
}

ImuSensor readImuSensor(const std::filesystem::path& path) {
  const SensorFile file(path);
  ImuSensor imu;
  imu.pose = file.pose();
  if (file.has("gyroscope_noise_density")) imu.noise = imuNoise(file);
  return imu;
}

ImuNoise readKalibrImu(const std::filesystem::path& path) {
  const SensorFile file(path, "imu0", true);
  const auto T_i_b = file.pose("T_i_b");
  if (T_i_b && (!T_i_b->R_BS.isIdentity(1e-6) || !T_i_b->p_BS.isZero(1e-6)))
    file.fail("T_i_b", "is not the identity: T_cam_imu of the camchain is of another IMU");
  return imuNoise(file);
}

double readAltimeterSigma(const std::filesystem::path& path) {
  return SensorFile(path).positive("noise_sigma");
}

TrueExtrinsics readTrueCameraExtrinsics(const std::filesystem::path& path) {
  const SensorFile file(path);
  const auto pose = file.pose("T_BS_cam0_true");
  if (!pose) throw InputError(path, "key 'T_BS_cam0_true' is missing");
  return {*pose, file.get<double>("time_offset_s")};
}

}  // namespace redbee
