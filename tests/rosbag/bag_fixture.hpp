// Bags written by ROS's own Python library (make_bag.py), and what is in them.
#pragma once

#include <cstdlib>

#include "processes/redbee/rosbag/import_rosbag.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/image_t.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {

inline constexpr int kFrames = 20;
inline constexpr int kImuSamples = 208;
inline constexpr int64_t kStart_us = 1'500'000'000'000'000;
inline constexpr int kWidth = 32, kHeight = 24;

inline uint8_t pixelOf(int k, int x, int y, int channel = 0) {
  return static_cast<uint8_t>((k + x + 2 * y + 40 * channel) % 256);
}

class RosbagTest : public testing::Test {
 protected:
  RosbagTest() {
    options_ = rosbagImporter().defaults;
    options_.source = folder_ / "f.bag";
    options_.log = folder_ / "f.lcm";
  }
  void SetUp() override {
    static const bool has_python =
        std::system("/usr/bin/python3 -c 'import rosbag, sensor_msgs.msg' 2>/dev/null") == 0;
    if (!has_python)
      GTEST_SKIP() << "no rosbag for Python: scripts/setup scripts/packages-rosbag.txt installs it";
  }
  void make(const std::string& kind, const std::string& compression = "none", const std::string& jpeg = "") {
    const std::string command = "/usr/bin/python3 " REDBEE_SOURCE_DIR "/tests/rosbag/make_bag.py " +
                                options_.source.string() + " " + kind + " " + compression + " " + jpeg;
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
  ImportSummary import() const {
    Progress progress("importing", "frames", true);
    return importRecording(rosbagImporter(), options_, progress);
  }
  std::string errorMessage() const {
    std::string line = errorMessageOf([&] { import(); });
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_EQ(line.rfind(options_.source.string(), 0), 0u) << line;
    EXPECT_FALSE(fs::exists(options_.log));
    return line;
  }
  void expectError(const std::string& part) const {
    const std::string line = errorMessage();
    EXPECT_NE(line.find(part), std::string::npos) << line;
  }
  static void expectWarning(const ImportSummary& summary, const std::string& part) {
    const auto& all = summary.warnings;
    EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                            [&](const std::string& line) { return line.find(part) != std::string::npos; }))
        << part << " is not among " << testing::PrintToString(all);
  }
  std::vector<image_t> frames() const { return messagesOn<image_t>(readEvents(options_.log), "CAMERA"); }

  void expectPlainFlight() const {
    const auto images = frames();
    ASSERT_EQ(images.size(), static_cast<size_t>(kFrames));
    for (int k = 0; k < kFrames; ++k) {
      const image_t& image = images[static_cast<size_t>(k)];
      EXPECT_EQ(image.utime, kStart_us + 50'000 * k);
      EXPECT_EQ(image.pixelformat, image_t::GRAY);
      const auto grey = decodeGrey(image);
      ASSERT_TRUE(grey);
      EXPECT_EQ((*grey)(3, 5), pixelOf(k, 5, 3));
      EXPECT_EQ((*grey)(kHeight - 1, kWidth - 1), pixelOf(k, kWidth - 1, kHeight - 1));
    }
  }

  ScratchFolder folder_;
  ImportOptions options_;
};

}  // namespace redbee::test
