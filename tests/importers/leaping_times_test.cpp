// Times years ahead, as of a driver that starts or of a damaged stamp, in each importer's recordings: left
// out, and said. Those of phones' tables: imu_table_times_test.cpp; of ROS messages: rosbag_faults_test.cpp.
#include "redbee/image_t.hpp"
#include "redbee/importers/import_video.hpp"
#include "redbee/importers/imu_table.hpp"
#include "tests/support/asl_folder.hpp"
#include "tests/support/synthetic_imu.hpp"
#include "tests/support/test_video.hpp"

namespace redbee::test {
namespace {

class LeapingTimes : public AslFolder {
 protected:
  static bool says(const std::vector<std::string>& warnings, const std::string& text) {
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const std::string& line) { return line.find(text) != std::string::npos; });
  }
  /// The line at a time four years later.
  std::string late(const fs::path& file, int line) const {
    const std::string row = lineOf(file, line);
    return std::to_string(kAslStart + 126'144'000'000'000'000) + row.substr(row.find(','));
  }
};

TEST_F(LeapingTimes, ListOfFrames) {
  const fs::path list = mav() / "cam0" / "data.csv";
  const std::string good = readText(list);
  for (const int line : {2, 4, 6}) {  // the first, one in the middle, the last
    replaceLine(list, line, late(list, line));
    const ImportSummary summary = import();
    EXPECT_EQ(summary.frames, 4);
    EXPECT_LT(summary.last_utime - summary.first_utime, 1'000'000);
    EXPECT_TRUE(says(summary.warnings, "cam0/data.csv: 1 of 5 times leap, the first (number " +
                                           std::to_string(line - 1) + ") by 12614"))
        << summary.warnings[0];
    writeText(list, good);
  }
}

TEST_F(LeapingTimes, KalibrsFrames) {
  const fs::path camera = mav() / "cam0";
  for (const fs::path& image : images_) fs::rename(image, camera / image.filename());
  fs::remove_all(camera / "data");
  fs::remove(camera / "data.csv");
  fs::rename(camera / images_[4].filename(), camera / "1726144000000000000.jpg");
  const ImportSummary summary = import();
  EXPECT_EQ(summary.frames, 4);
  EXPECT_TRUE(says(summary.warnings, "cam0: 1 of 5 times leap")) << summary.warnings[0];
}

TEST_F(LeapingTimes, ImuAndAltimeterOfAFolder) {
  const fs::path imu = mav() / "imu0" / "data.csv", altimeter = mav() / "altimeter0" / "data.csv";
  replaceLine(imu, 61, late(imu, 61));
  replaceLine(imu, 30, late(imu, 30));
  std::string heights = "#timestamp [ns],height\n";
  for (int k = 0; k < 10; ++k) heights += std::to_string(kAslStart + k * 20'000'000LL) + ",7\n";
  writeText(altimeter, heights);
  replaceLine(altimeter, 11, late(altimeter, 11));
  const ImportSummary summary = import();
  EXPECT_EQ(summary.imu_samples, 58);
  EXPECT_EQ(summary.altitudes, 9);
  EXPECT_TRUE(says(summary.warnings, "imu0/data.csv: 2 of 60 times leap"));
  EXPECT_TRUE(says(summary.warnings, "altimeter0/data.csv: 1 of 10 times leap"));
}

TEST_F(LeapingTimes, TablesBesideAVideo) {
  std::string rows;
  for (int k = 0; k < 400; ++k)
    rows += std::to_string(k == 399 || k == 200 ? 126'144'000 : 5e-3 * k) + ",0,0,0,0,0,9.8\n";
  writeText(folder_ / "imu.csv", "t_s,gx,gy,gz,ax,ay,az\n" + rows);
  writeText(folder_ / "imu.gcsv", "GYROFLOW IMU LOG\ntscale,1\nascale,1\nt,gx,gy,gz,ax,ay,az\n" + rows);
  for (const char* name : {"imu.csv", "imu.gcsv"}) {
    const ImuTable table = readImuTable(folder_ / name, "v.mp4", {});
    EXPECT_EQ(table.samples.size(), 398u);
    EXPECT_TRUE(says(table.warnings, std::string(name) + ": 2 of 400 times leap, the first (number 201)"));
  }
}

TEST_F(LeapingTimes, Videos) {
  TestVideo video;
  video.image = numbered;
  ImportOptions options;
  options.log = log();
  Progress progress("importing", "frames", true);
  for (const char* name : {"v.mp4", "v.mkv"}) {
    options.source = folder_ / name;
    video.container = options.source.extension() == ".mkv" ? "matroska" : "mp4";
    video.late_frames = 1;
    writeTestVideo(options.source, video);
    const ImportSummary summary = importRecording(videoImporter(), options, progress);
    EXPECT_EQ(summary.frames, 29);
    EXPECT_EQ(summary.last_utime, 28 * 40'000);
    EXPECT_TRUE(
        says(summary.warnings, "the times of 1 frame leap, the first by 129600 s at frame 29: left out"));
    fs::remove(log());
    video.late_frames = 10;
    writeTestVideo(options.source, video);
    EXPECT_NE(errorMessageOf([&] {
                importRecording(videoImporter(), options, progress);
              }).find("times leap by 129600 s at frame 20: the clock was set during the recording"),
              std::string::npos);
    EXPECT_FALSE(fs::exists(log()));
  }
}

}  // namespace
}  // namespace redbee::test
