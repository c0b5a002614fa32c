// No member of a parameter struct may be missing from the configuration.
#include <gtest/gtest.h>

#include <algorithm>

#include "redbee/configuration/configuration.hpp"
#include "tests/configuration/field_count.hpp"

namespace redbee {
namespace {

using testing::fieldCount;

/// Keys directly in a section, not those of its sections.
size_t keysIn(const std::string& section) {
  const auto keys = configurationKeys();
  return static_cast<size_t>(std::count_if(keys.begin(), keys.end(), [&](const std::string& key) {
    return key.rfind('.') == section.size() && key.compare(0, section.size(), section) == 0;
  }));
}

TEST(ConfigurationCoverage, everyParameterHasAKey) {
  EXPECT_EQ(keysIn("segmentation"), fieldCount<SegmentationParameters>());
  EXPECT_EQ(keysIn("visual.tracker"), fieldCount<TrackerParameters>());
  EXPECT_EQ(keysIn("visual.ransac"), fieldCount<RansacParameters>());
  EXPECT_EQ(keysIn("front_plane.ransac"), fieldCount<RansacParameters>());
  EXPECT_EQ(keysIn("channels"), fieldCount<Channels>());
  EXPECT_EQ(keysIn("waits"), fieldCount<WaitParameters>());
}

TEST(ConfigurationCoverage, everyParameterBesideANestedStructHasAKey) {
  const size_t nested_visual = 2;  // tracker, ransac
  EXPECT_EQ(keysIn("visual"), fieldCount<VisualParameters>() - nested_visual);
  // The biases stand with the IMU's noise; the extrinsics with camera and plane.
  const size_t nested_inertial = 3;  // extrinsics, noise, limits
  const size_t biases = 4;
  EXPECT_EQ(keysIn("inertial") + biases, fieldCount<InertialParameters>() - nested_inertial);
  const size_t presence = 1;
  EXPECT_EQ(keysIn("imu"), presence + biases + fieldCount<ImuNoise>() + fieldCount<ImuSampleLimits>());
}

}  // namespace
}  // namespace redbee
