#include "processes/redbee/export/camera_infos.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace redbee::test {
namespace {

constexpr int64_t kStep_us = 40'000;
constexpr int kFrames = 50;

Configuration configurationOf(bool zooms) {
  Configuration configuration;
  configuration.camera = {640, 480, 500, 510, 319.5, 239.5, {}};
  configuration.inertial.lens.enabled = zooms;
  configuration.inertial.lens.on_camera_clock = true;
  configuration.inertial.extrinsics.timeshift_s = 0.013;
  return configuration;
}

image_t imageAt(int64_t utime) {
  image_t image{};
  image.utime = utime;
  image.width = 640;
  image.height = 480;
  return image;
}

/// The focal length of each image, of a log in which the lens doubles it every second, and says so every
/// third image.
std::map<int64_t, double> focalLengths(const Configuration& configuration, bool speaks) {
  std::map<int64_t, double> found;
  CameraInfos infos(configuration,
                    [&](const std::string& topic, int64_t utime, const CameraIntrinsics& camera) {
                      EXPECT_EQ(topic, "/camera");
                      EXPECT_NEAR(camera.fy / camera.fx, 1.02, 1e-9);
                      EXPECT_TRUE(found.emplace(utime, camera.fx).second) << utime;
                    });
  for (int k = 0; k < kFrames; ++k) {
    infos.add("/camera", imageAt(1'000'000 + k * kStep_us));
    if (!speaks || k % 3 != 0) continue;
    lens_t lens{};
    lens.utime = 1'000'000 + k * kStep_us;
    lens.has_focal_length = 1;
    lens.width = 640;
    lens.focal_length = 500 * std::exp2(1e-6 * static_cast<double>(k * kStep_us));
    infos.add(lens);
  }
  infos.finish();
  return found;
}

TEST(CameraInfos, EachImageHasTheFocalLengthThatItWasTakenWith) {
  const auto found = focalLengths(configurationOf(true), true);
  ASSERT_EQ(found.size(), static_cast<size_t>(kFrames));
  for (const auto& [utime, fx] : found) {
    const double seconds = 1e-6 * static_cast<double>(utime - 1'000'000);
    const bool is_between = seconds <= (kFrames - 3) * 1e-6 * kStep_us;
    EXPECT_TRUE(!is_between || std::abs(fx - 500 * std::exp2(seconds)) < 1e-6) << seconds << ' ' << fx;
  }
}

TEST(CameraInfos, ALensThatDoesNotSpeakOrDoesNotZoomHasTheConfiguredOne) {
  for (const auto& found :
       {focalLengths(configurationOf(true), false), focalLengths(configurationOf(false), true)}) {
    ASSERT_EQ(found.size(), static_cast<size_t>(kFrames));
    for (const auto& [utime, fx] : found) EXPECT_EQ(fx, 500) << utime;
  }
}

TEST(CameraInfos, AnImageOfAnotherSizeHasNone) {
  CameraInfos infos(configurationOf(false),
                    [](const std::string&, int64_t, const CameraIntrinsics&) { FAIL(); });
  image_t image = imageAt(1'000'000);
  image.width = 320;
  infos.add("/camera", image);
  infos.finish();
}

}  // namespace
}  // namespace redbee::test
