// A ROS 2 bag is a folder. How single files are read: tests/rosbag, tests/integration/speaks_mcap.
#include "redbee/importers/mcap/import_mcap.hpp"

#include <gtest/gtest.h>
#include <zstd.h>

#include "redbee/image_t.hpp"
#include "redbee/importers/recognise.hpp"
#include "tests/support/mcap_recording.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_imu.hpp"

namespace redbee::test {
namespace {

class RosBagFolder : public testing::Test {
 protected:
  ImportSummary import(bool keep_going = false) {
    ImportOptions options = mcapImporter().defaults;
    options.source = folder_ / "bag/";
    options.log = folder_ / "f.lcm";
    options.keep_going = keep_going;
    Progress progress("importing", "frames", true);
    return importRecording(mcapImporter(), options, progress);
  }
  fs::path part(const std::string& end) const { return folder_ / ("bag/bag" + end); }
  ScratchFolder folder_;
};

TEST_F(RosBagFolder, PartsAreOneRecording) {
  writeMcapRecording(part("_0.mcap"), 0, 20, swingingImu(200, 1, 1));
  for (int k = 1; k < 11; ++k)
    writeMcapRecording(part("_" + std::to_string(k) + ".mcap"), 20 * k, 20, swingingImu(200, 1, 1 + k));
  writeText(folder_ / "bag/metadata.yaml", "rosbag2_bagfile_information:\n");
  EXPECT_EQ(recogniseRecording(folder_ / "bag"), "mcap");
  const ImportSummary summary = import();
  EXPECT_EQ(summary.frames, 220);
  EXPECT_EQ(summary.imu_samples, 2200);
  EXPECT_EQ(summary.vehicle.name, "bag");
  EXPECT_TRUE(std::none_of(summary.warnings.begin(), summary.warnings.end(), [](const std::string& line) {
    return line.find("not in the order") != std::string::npos || line.find("left out") != std::string::npos;
  }));
  const auto frames = messagesOn<image_t>(readEvents(folder_ / "f.lcm"), "CAMERA");
  for (size_t k = 0; k < frames.size(); ++k)
    EXPECT_EQ(frames[k].utime, 1'000'000 + 50'000 * static_cast<int64_t>(k));
}

TEST_F(RosBagFolder, DamageOfAPartIsSaidOnce) {
  for (int k = 0; k < 3; ++k)
    writeMcapRecording(part("_" + std::to_string(k) + ".mcap"), 20 * k, 20, swingingImu(200, 1, 1 + k));
  fs::resize_file(part("_2.mcap"), fs::file_size(part("_2.mcap")) * 9 / 10);
  EXPECT_NE(errorMessageOf([&] { import(); }).find("bag_2.mcap: byte"), std::string::npos);
  const ImportSummary summary = import(true);
  EXPECT_GE(summary.frames, 40);
  EXPECT_EQ(std::count_if(
                summary.warnings.begin(), summary.warnings.end(),
                [](const std::string& line) { return line.find("bag_2.mcap: byte") != std::string::npos; }),
            1);
}

TEST_F(RosBagFolder, MessagesThatArePackedAreUnpacked) {
  const auto pack = [](const std::vector<uint8_t>& bytes) {
    std::vector<uint8_t> packed(ZSTD_compressBound(bytes.size()));
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 1));
    return packed;
  };
  const std::vector<ImuSample> imu = swingingImu(200, 1, 1);
  writeMcapRecording(part("_0.mcap"), 0, 20, imu, pack);
  EXPECT_EQ(import().imu_samples, 200);
  const auto frames = messagesOn<image_t>(readEvents(folder_ / "f.lcm"), "CAMERA");
  ASSERT_EQ(frames.size(), 20u);
  const auto grey = decodeGrey(frames[7]);
  ASSERT_TRUE(grey);
  EXPECT_EQ(cv::norm(*grey, texture(64, 48, 7, 1), cv::NORM_INF), 0);
  int messages = 0;
  writeMcapRecording(part("_0.mcap"), 0, 20, imu, [&](const std::vector<uint8_t>& bytes) {
    std::vector<uint8_t> packed = pack(bytes);
    if (++messages == 100) packed.resize(packed.size() / 2);
    return packed;
  });
  EXPECT_NE(errorMessageOf([&] { import(); }).find("/imu, message 80: does not start like CDR"),
            std::string::npos);
  EXPECT_EQ(import(true).imu_samples, 199);
}

TEST_F(RosBagFolder, WhatIsNoMcapSaysHowToMakeOne) {
  writeText(part("_0.db3"), std::string("SQLite format 3\0", 16));
  EXPECT_EQ(recogniseRecording(folder_ / "bag"), "mcap");
  EXPECT_NE(errorMessageOf([&] {
              import();
            }).find("bag_0.db3: is a ROS 2 bag in SQLite, import mcap reads MCAP: ros2 bag convert"),
            std::string::npos);
  fs::remove(part("_0.db3"));
  writeText(part("_0.mcap.zstd"), "\x28\xB5\x2F\xFD");
  EXPECT_EQ(recogniseRecording(folder_ / "bag"), "mcap");
  EXPECT_NE(
      errorMessageOf([&] { import(); }).find("bag_0.mcap.zstd: is packed by Zstandard: unpack it first"),
      std::string::npos);
  fs::remove(part("_0.mcap.zstd"));
  EXPECT_NE(errorMessageOf([&] { import(); }).find("holds no .mcap file"), std::string::npos);
}

}  // namespace
}  // namespace redbee::test
