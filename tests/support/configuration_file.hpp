// Vehicle files written by a test, and the error messages for invalid ones.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "redbee/configuration/configuration.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {

inline const fs::path kConfigFolder = fs::path(REDBEE_SOURCE_DIR) / "config";
inline constexpr const char* kCamera =
    "camera: {width: 640, height: 480, fx: 500, fy: 500, cx: 319.5, cy: 239.5}\n";

/// Each test has its own folder.
class ConfigurationFile : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    writeText(folder_ / name, text);
    return folder_ / name;
  }
  Configuration load(const std::string& text) const { return loadConfiguration(write("vehicle.yaml", text)); }
  /// The error message for vehicle.yaml, without the folder.
  std::string errorMessage(const std::string& text) const {
    try {
      load(text);
    } catch (const ConfigurationError& error) {
      const std::string what = error.what();
      EXPECT_EQ(std::count(what.begin(), what.end(), '\n'), 0) << what;
      EXPECT_THAT(what, testing::StartsWith((folder_ / "").string()));
      return what.substr((folder_ / "").string().size());
    }
    return "";
  }

  ScratchFolder folder_;
};

}  // namespace redbee::test
