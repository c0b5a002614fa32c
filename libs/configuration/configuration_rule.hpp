// Which values a key may have, and the error message for others; internal to the configuration.
#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include "redbee/configuration/configuration_table.hpp"
#include "redbee/configuration/configuration_value.hpp"
#include "redbee/configuration/listen_address.hpp"
#include "redbee/geometry/camera_model.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/mavlink/link_address.hpp"

namespace redbee::configuration {

/// Predicate of the allowed values, and the error message for others.
template <typename Predicate>
struct Rule {
  Predicate holds;
  std::string message;
};
template <typename Predicate>
Rule(Predicate, const char*) -> Rule<Predicate>;
template <typename Predicate>
Rule(Predicate, std::string) -> Rule<Predicate>;

inline const Rule anything{[](const auto&) { return true; }, ""};
inline const Rule positive{[](auto x) { return x > 0; }, "must be above 0"};
/// Above 0, and no more than any vehicle has: arithmetic with a sigma of 1e300 has no result.
inline auto positiveTo(double most) {
  std::string limit = std::to_string(static_cast<long long>(most));
  return Rule{[most](double x) { return x > 0 && x <= most; }, "must be above 0 and at most " + limit};
}
inline auto zeroTo(double most) {
  std::string limit = std::to_string(static_cast<long long>(most));
  return Rule{[most](double x) { return x >= 0 && x <= most; }, "must lie from 0 to " + limit};
}
inline const Rule hangTimeout{[](auto x) { return x >= 0.5; },
                              "must be at least 0.5: a busy process gives signs of life 0.1 s apart"};
inline const Rule notNegative{[](auto x) { return x >= 0; }, "must not be negative"};
inline const Rule fraction{[](auto x) { return x >= 0 && x <= 1; }, "must lie from 0 to 1"};
inline const Rule probability{[](auto x) { return x > 0 && x < 1; }, "must lie between 0 and 1"};
inline const Rule odd{[](int x) { return x > 0 && x % 2 == 1; }, "must be odd and above 0"};
inline const Rule atLeastTwo{[](int x) { return x >= 2; }, "must be at least 2"};
inline const Rule halving{[](int x) { return x == 1 || x == 2 || x == 4; }, "must be 1, 2 or 4"};
inline const Rule pyramid{[](int x) { return x >= 1 && x <= 8; }, "must lie from 1 to 8"};
inline const Rule fourOrMore{[](int x) { return x >= 4; },
                             "must be at least 4: so many points fix a homography"};
inline const Rule imageSide{[](int x) { return x >= 16 && x <= 16384; }, "must lie from 16 to 16384"};
inline const Rule notEmpty{[](const std::string& x) { return !x.empty(); }, "must not be empty"};
inline const Rule cameraModel{[](const std::string& x) {
                                const CameraModelType* type = findCameraModel(x);
                                return type != nullptr && type->name == x;
                              },
                              "must be " + cameraModelNames()};
inline const Rule autopilotLink{
    [](const std::string& x) { return x.empty() || mavlink::linkAddressOf(x).has_value(); },
    std::string("must be ") + mavlink::kLinkForms + ", or empty"};
inline const Rule listenAddress{
    [](const std::string& x) { return x.empty() || listenAddressOf(x).has_value(); },
    std::string("must be ") + kListenForms + ", or empty"};
inline const Rule systemId{[](int x) { return x >= 1 && x <= 255; }, "must lie from 1 to 255"};
inline const Rule absolutePath{[](const std::string& x) { return x.empty() || x.front() == '/'; },
                               "must be a path from the root (/...), or empty"};
inline const Rule rate{[](double x) { return x >= 0.1 && x <= 1000; }, "must lie from 0.1 to 1000"};
inline const Rule rateOrAny{[](double x) { return x >= 0 && x <= 1000; }, "must lie from 0 to 1000"};
inline const Rule percent{[](int x) { return x >= 0 && x <= 100; }, "must lie from 0 to 100"};
inline const Rule angleSigma{[](double x) { return x > 0 && x <= 180; }, "must lie between 0 and 180"};
inline const Rule zoomRange{[](double x) { return x == 0 || (x >= 1 && x <= 100); },
                            "must be 0, or lie from 1 to 100: the longest focal length over the shortest"};
inline const Rule focalSigma{[](double x) { return x > 0 && x <= 0.5; },
                             "must be above 0 and at most 0.5, of the focal length"};
inline const Rule slopeSigma{[](double x) { return x >= 0 && x <= 45; }, "must lie from 0 to 45"};
inline const Rule depression{[](double x) { return x >= 1 && x <= 80; }, "must lie from 1 to 80"};
inline const Rule cameraMount{[](const std::string& x) { return x == "body" || x == "gimbal"; },
                              "must be body or gimbal"};
inline const Rule stampedEvent{
    [](const std::string& x) { return x == "middle" || x == "exposure_start" || x == "readout_end"; },
    "must be middle, exposure_start or readout_end"};
inline const Rule lineDelay{[](double x) { return x >= -1e-3 && x <= 1e-3; },
                            "must lie from -0.001 to 0.001: the read-out time over the number of rows"};
inline const Rule mounting{[](double x) { return x >= -10 && x <= 10; }, "must lie from -10 to 10"};
inline const Rule rotation{[](const Eigen::Matrix3d& R) { return isRotation(R, 1e-5); },
                           "is no rotation: its rows must be orthonormal to 1e-5, its determinant +1"};
inline const Rule nearIdentity{
    [](const Eigen::Matrix3d& M) { return (M - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 0.2; },
    "must lie within 0.2 of the identity: errors of a gyro's axes are a few percent"};
inline const Rule variances{[](const Vector8d& v) { return (v.array() > 0).all(); },
                            "must be eight variances above 0"};
inline const Rule channelName{[](const std::string& x) {
                                return !x.empty() && x.size() <= 63 &&
                                       x.find_first_of(" \t\r\n") == std::string::npos;
                              },
                              "must be a name of 1 to 63 bytes without blanks"};

/// A key whose value is validated by `rule` and stored in the member that `access` returns.
template <typename Access, typename Predicate>
Setting setting(std::string key, Access access, const Rule<Predicate>& rule) {
  using Value = std::decay_t<decltype(access(std::declval<Configuration&>()))>;
  auto read = [access, rule](Configuration& configuration, const YAML::Node& node) {
    Value value = access(configuration);
    readValue(node, value);
    if (!rule.holds(value)) throw ValueError(rule.message);
    access(configuration) = value;
  };
  auto text = [access](const Configuration& configuration) { return valueText(access(configuration)); };
  return {std::move(key), std::move(read), std::move(text)};
}

}  // namespace redbee::configuration
