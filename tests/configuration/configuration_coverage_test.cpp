// Every member of a parameter struct has a key, and every key fills a member of its own.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "redbee/configuration/configuration.hpp"
#include "redbee/configuration/configuration_table.hpp"
#include "redbee/configuration/configuration_value.hpp"
#include "tests/configuration/field_count.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {
namespace {

/// Keys directly in a section, not those of its sections.
size_t keysIn(const std::string& section) {
  const auto keys = configurationKeys();
  return static_cast<size_t>(std::count_if(keys.begin(), keys.end(), [&](const std::string& key) {
    return key.rfind('.') == section.size() && key.compare(0, section.size(), section) == 0;
  }));
}

TEST(ConfigurationCoverage, EveryParameterHasAKey) {
  const size_t detection_groups = 6;
  EXPECT_EQ(keysIn("detection"), fieldCount<DetectionParameters>() - detection_groups);
  EXPECT_EQ(keysIn("detection.parallax"), fieldCount<ParallaxParameters>());
  EXPECT_EQ(keysIn("detection.appearance"), fieldCount<AppearanceParameters>());
  EXPECT_EQ(keysIn("detection.shadow"), fieldCount<ShadowParameters>());
  EXPECT_EQ(keysIn("detection.refinement"), fieldCount<RefinementParameters>());
  EXPECT_EQ(keysIn("detection.objects"), fieldCount<ObjectParameters>());
  EXPECT_EQ(keysIn("detection.two_planes"), fieldCount<TwoPlaneParameters>());
  EXPECT_EQ(keysIn("visual.tracker"), fieldCount<TrackerParameters>());
  EXPECT_EQ(keysIn("visual.ransac"), fieldCount<RansacParameters>());
  EXPECT_EQ(keysIn("front_plane.ransac"), fieldCount<RansacParameters>());
  EXPECT_EQ(keysIn("channels"), fieldCount<Channels>());
  EXPECT_EQ(keysIn("waits"), fieldCount<WaitParameters>());
  EXPECT_EQ(keysIn("capture"), fieldCount<CaptureParameters>());
  EXPECT_EQ(keysIn("serve"), fieldCount<ServeParameters>());
  EXPECT_EQ(keysIn("autopilot"), fieldCount<AutopilotParameters>());
  EXPECT_EQ(keysIn("geolocation"), fieldCount<GeolocationParameters>());
  EXPECT_EQ(keysIn("ground_link"), fieldCount<GroundLinkParameters>());
  EXPECT_EQ(keysIn("gimbal"), fieldCount<GimbalParameters>());
  EXPECT_EQ(keysIn("lens"), fieldCount<LensParameters>());
  EXPECT_EQ(keysIn("watch"), fieldCount<WatchParameters>());
}

TEST(ConfigurationCoverage, EveryParameterBesideANestedStructHasAKey) {
  const size_t nested_visual = 2;  // tracker, ransac
  EXPECT_EQ(keysIn("visual"), fieldCount<VisualParameters>() - nested_visual);
  // The biases and the gyro's axes stand with the IMU's noise; the extrinsics with camera and plane.
  const size_t nested_inertial = 5;  // extrinsics, noise, limits, gimbal, lens
  const size_t errors = 5;
  EXPECT_EQ(keysIn("inertial") + errors, fieldCount<InertialParameters>() - nested_inertial);
  const size_t presence = 1;
  EXPECT_EQ(keysIn("imu"), presence + errors + fieldCount<ImuNoise>() + fieldCount<ImuSampleLimits>());
}

Configuration validConfiguration() {
  Configuration configuration;
  configuration.camera = intrinsics();
  return configuration;
}

std::vector<std::string> emittedLines(const Configuration& configuration) {
  std::istringstream text(emitYaml(configuration));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

YAML::Node valueOf(const Configuration& configuration, const std::string& key) {
  YAML::Node node = YAML::Load(emitYaml(configuration));
  std::istringstream names(key);
  for (std::string name; std::getline(names, name, '.');) node.reset(node[name]);
  return node;
}

bool sameValue(const YAML::Node& a, const YAML::Node& b) {
  if (a.IsSequence()) {
    return b.IsSequence() && a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), sameValue);
  }
  double x = 0;
  double y = 0;
  if (YAML::convert<double>::decode(a, x) && YAML::convert<double>::decode(b, y)) return x == y;
  return a.Scalar() == b.Scalar();
}

/// A value of every form that a key may have; each key refuses those that are not of its own.
const std::vector<std::string>& values() {
  // clang-format off
  static const std::vector<std::string> all = {
      "true", "false", "gimbal", "readout_end", "33", "3", "2", "4", "0.375", "0.625", "ANOTHER",
      "equidistant", "paper", "propagated", "two_planes", "parallax", "udp:127.0.0.1:14540", "/etc/redbee/key",
      "127.0.0.1:8080",
      "[0.125, 0.25, 0.375]", "[0.125, 0.25, 0.375, 0.5, 0.625]",
      "[0, -1, 0, 1, 0, 0, 0, 0, 1]", "[1, 2, 3, 4, 5, 6, 7, 8]",
      "0.0009765625", "[1, 0.125, 0, 0.125, 1, 0, 0, 0, 1]"};
  // clang-format on
  return all;
}

/// The configuration with a new value for this key, and the value.
std::optional<std::pair<Configuration, std::string>> withNewValue(const std::string& key) {
  for (const std::string& value : values()) {
    Configuration changed = validConfiguration();
    if (sameValue(valueOf(changed, key), YAML::Load(value))) continue;
    try {
      configuration::findSetting(key)->read(changed, YAML::Load(value));
      return std::make_pair(changed, value);
    } catch (const configuration::ValueError&) {
      continue;
    }
  }
  return std::nullopt;
}

TEST(ConfigurationCoverage, ANewValueChangesExactlyOneLine) {
  const std::vector<std::string> before = emittedLines(validConfiguration());
  for (const std::string& key : configurationKeys()) {
    const auto changed = withNewValue(key);
    ASSERT_TRUE(changed) << key << ": no value of this list is a new one";
    const std::vector<std::string> after = emittedLines(changed->first);
    ASSERT_EQ(after.size(), before.size()) << key;
    std::vector<std::string> lines;
    for (size_t i = 0; i < after.size(); ++i) {
      if (after[i] != before[i]) lines.push_back(after[i]);
    }
    EXPECT_EQ(lines.size(), 1U) << key << ": " << testing::PrintToString(lines);
    EXPECT_TRUE(sameValue(valueOf(changed->first, key), YAML::Load(changed->second)))
        << key << ": " << changed->second << " is read back as " << valueOf(changed->first, key);
  }
}

}  // namespace
}  // namespace redbee::test
