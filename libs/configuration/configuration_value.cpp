#include "redbee/configuration/configuration_value.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "redbee/geometry/row_major.hpp"

namespace redbee::configuration {
namespace {

[[noreturn]] void refuse(const std::string& wanted, const YAML::Node& node) {
  throw ValueError("must be " + wanted + (node.IsScalar() ? ", is \"" + node.Scalar() + "\"" : ""));
}

template <typename Enumeration>
using Names = std::array<std::pair<const char*, Enumeration>, 2>;

constexpr Names<FusionNoise> kFusionNoises{
    {{"propagated", FusionNoise::kPropagated}, {"paper", FusionNoise::kPaper}}};

template <typename Enumeration>
void readName(const YAML::Node& node, const Names<Enumeration>& names, Enumeration& value) {
  std::string wanted;
  for (const auto& [name, named] : names) {
    if (node.IsScalar() && node.Scalar() == name) {
      value = named;
      return;
    }
    wanted += (wanted.empty() ? "" : " or ") + std::string(name);
  }
  refuse(wanted, node);
}

template <typename Enumeration>
std::string nameOf(const Names<Enumeration>& names, Enumeration value) {
  return std::find_if(names.begin(), names.end(), [&](const auto& name) { return name.second == value; })
      ->first;
}

template <typename Integer>
Integer readInteger(const YAML::Node& node) {
  int64_t wide = 0;
  const bool converted = node.IsScalar() && YAML::convert<int64_t>::decode(node, wide);
  if (!converted || wide < int64_t{std::numeric_limits<Integer>::min()} ||
      wide > int64_t{std::numeric_limits<Integer>::max()}) {
    refuse("a whole number", node);
  }
  return static_cast<Integer>(wide);
}

std::vector<double> readNumbers(const YAML::Node& node, size_t count) {
  const std::string wanted = "a list of " + std::to_string(count) + " numbers";
  if (!node.IsSequence()) refuse(wanted, node);
  if (node.size() != count) {
    throw ValueError("must be " + wanted + ", has " + std::to_string(node.size()));
  }
  std::vector<double> numbers(node.size());
  for (size_t i = 0; i < numbers.size(); ++i) readValue(node[i], numbers[i]);
  return numbers;
}

std::string listText(const double* numbers, Eigen::Index count) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < count; ++i) text += (i > 0 ? ", " : "") + valueText(numbers[i]);
  return text + "]";
}

}  // namespace

void readValue(const YAML::Node& node, double& value) {
  double number = 0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, number)) refuse("a number", node);
  if (!std::isfinite(number)) refuse("a finite number", node);
  value = number;
}

void readValue(const YAML::Node& node, int& value) { value = readInteger<int>(node); }
void readValue(const YAML::Node& node, uint32_t& value) { value = readInteger<uint32_t>(node); }

void readValue(const YAML::Node& node, bool& value) {
  if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value)) refuse("true or false", node);
}

void readValue(const YAML::Node& node, std::string& value) {
  if (!node.IsScalar()) refuse("a text", node);
  value = node.Scalar();
}

void readValue(const YAML::Node& node, FusionNoise& value) { readName(node, kFusionNoises, value); }

void readValue(const YAML::Node& node, std::vector<double>& value) {
  if (!node.IsSequence()) refuse("a list of numbers", node);
  value = readNumbers(node, node.size());
}

void readValue(const YAML::Node& node, Eigen::Vector3d& value) {
  value = Eigen::Map<const Eigen::Vector3d>(readNumbers(node, 3).data());
}

void readValue(const YAML::Node& node, Eigen::Matrix3d& value) {
  value = Eigen::Map<const RowMajor3d>(readNumbers(node, 9).data());
}

void readValue(const YAML::Node& node, Vector8d& value) {
  value = Eigen::Map<const Vector8d>(readNumbers(node, 8).data());
}

std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::string valueText(double value) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return std::string(text.data(), result.ptr);
}

std::string valueText(int value) { return std::to_string(value); }
std::string valueText(uint32_t value) { return std::to_string(value); }
std::string valueText(bool value) { return value ? "true" : "false"; }

std::string valueText(const std::string& value) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << value;
  return emitter.c_str();
}

std::string valueText(FusionNoise value) { return nameOf(kFusionNoises, value); }
std::string valueText(const std::vector<double>& value) {
  return listText(value.data(), static_cast<Eigen::Index>(value.size()));
}
std::string valueText(const Eigen::Vector3d& value) { return listText(value.data(), 3); }
std::string valueText(const Eigen::Matrix3d& value) { return listText(RowMajor3d(value).data(), 9); }
std::string valueText(const Vector8d& value) { return listText(value.data(), 8); }

}  // namespace redbee::configuration
