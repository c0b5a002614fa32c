// Conversion of configuration values between YAML text and C++ types; internal to the configuration.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "redbee/fusion/homography_fusion.hpp"

namespace redbee::configuration {

/// what() states what is wrong with a value; the caller adds file and line.
class ValueError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throw ValueError on wrong types and on numbers that are not finite.
void readValue(const YAML::Node& node, double& value);
void readValue(const YAML::Node& node, int& value);
void readValue(const YAML::Node& node, uint32_t& value);
void readValue(const YAML::Node& node, bool& value);
void readValue(const YAML::Node& node, std::string& value);
void readValue(const YAML::Node& node, FusionNoise& value);
/// A list of any length.
void readValue(const YAML::Node& node, std::vector<double>& value);
void readValue(const YAML::Node& node, Eigen::Vector3d& value);
/// Nine entries, row-major.
void readValue(const YAML::Node& node, Eigen::Matrix3d& value);
void readValue(const YAML::Node& node, Vector8d& value);

/// "a, b, c", for messages.
std::string listOf(const std::vector<std::string>& names);

/// YAML text that reads back to exactly the same value.
std::string valueText(double value);
std::string valueText(int value);
std::string valueText(uint32_t value);
std::string valueText(bool value);
std::string valueText(const std::string& value);
std::string valueText(FusionNoise value);
std::string valueText(const std::vector<double>& value);
std::string valueText(const Eigen::Vector3d& value);
std::string valueText(const Eigen::Matrix3d& value);
std::string valueText(const Vector8d& value);

}  // namespace redbee::configuration
