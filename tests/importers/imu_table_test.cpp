// IMU recordings of phones and loggers, as their documentation has them.
#include <fstream>

#include "redbee/importers/import_video.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/results/video_writer.hpp"
#include "tests/importers/imu_table_fixture.hpp"

namespace redbee::test {
namespace {

TEST_F(ImuTableTest, SensorLoggersFilesAreJoined) {
  writeSensorLogger("android,false", 1);
  for (const std::string name : {"", "Gyroscope.csv", "TotalAcceleration.csv"}) {
    const ImuTable table = read(name);
    expectMotion(table, 0);
    EXPECT_TRUE(warns(table, "the video is taken to begin with the recording"));
  }
  // The app names its videos by their start: this one began 0.25 s after the recording.
  const ImuTable beside = read("", "1700000000250.mp4");
  expectMotion(beside, 0.25);
  EXPECT_FALSE(warns(beside, "is taken to begin"));
  EXPECT_EQ(toUtime(beside.samples.front().time),
            -250'000 + 6'000);  // the first with an accelerometer before it
}

TEST_F(ImuTableTest, AnIphonesSignsAreTurned) {
  writeSensorLogger("ios,false", -1);
  expectMotion(read(""), 0);
  writeSensorLogger("ios,true", 1);
  expectMotion(read(""), 0);
  fs::remove(folder_ / "Metadata.csv");
  EXPECT_TRUE(warns(read(""), "no Metadata.csv"));
}

TEST_F(ImuTableTest, GravityIsAddedToWhatLeavesItOut) {
  writeSensorLogger("android,false", 1);
  fs::rename(folder_ / "TotalAcceleration.csv", folder_ / "Gravity.csv");
  expectError("", "holds neither TotalAcceleration.csv nor both Accelerometer.csv and Gravity.csv");
  write("Accelerometer.csv", "time,seconds_elapsed,z,y,x\n" + rows("N,S,0,0,0.5", kStart_ns, 3'000'000));
  const ImuTable table = read("");
  ASSERT_GE(table.samples.size(), size_t{kSamples - 2});
  EXPECT_NEAR(table.samples[50].accel.x(), 0.5, 1e-9);
  EXPECT_NEAR(table.samples[50].accel.y(), forceAt(seconds(table.samples[50].time.time_since_epoch())), 1e-3);
}

TEST_F(ImuTableTest, RowsThatAreRepeatedAreLeftOut) {
  writeSensorLogger("android,false", 1);
  const std::string gyro = readText(folder_ / "Gyroscope.csv");
  const size_t second = gyro.find('\n', gyro.find('\n') + 1) + 1;
  write("Gyroscope.csv", gyro.substr(0, second) + gyro.substr(gyro.find('\n') + 1));
  const ImuTable table = read("");
  expectMotion(table, 0);
  EXPECT_TRUE(warns(table, "1 of 301 do not come after the one before"));
}

TEST_F(ImuTableTest, MarsLoggersClockIsThatOfTheFrames) {
  const int64_t boot = 5'000'000'000'000;
  write("gyro_accel.csv",
        "Timestamp[nanosec], gx[rad/s], gy[rad/s], gz[rad/s], ax[m/s^2], ay[m/s^2], az[m/s^2], Unix "
        "time[nanosec]\n" +
            rows("N,0,0,G,0,A,0,1700000000000000000", boot, 0));
  expectError("gyro_accel.csv", "holds neither frame_timestamps.txt nor movie_metadata.csv");
  write("frame_timestamps.txt",
        std::to_string(boot + 100'000'000) + "\n" + std::to_string(boot + 133'000'000) + "\n");
  expectMotion(read("gyro_accel.csv"), 0.1, kSamples);
  fs::remove(folder_ / "frame_timestamps.txt");
  write("movie_metadata.csv", "Timestamp[nanosec],fx[px],fy[px],Frame No.\n" +
                                  std::to_string(boot + 200'000'000) + ",1000,1000,1\n");
  expectMotion(read(""), 0.2, kSamples);
}

TEST_F(ImuTableTest, OpenCameraSensorsTablesHaveNoHeader) {
  const int64_t boot = 7'000'000'000'000;
  write("VID_1_gyro.csv", rows("0,0,G,N", boot, 0));
  write("VID_1_accel.csv", rows("0,A,0,N", boot, 2'000'000));
  expectError("VID_1_gyro.csv", "has neither VID_1_imu_timestamps.csv nor VID_1_timestamps.csv beside it");
  write("VID_1_timestamps.csv", std::to_string(boot + 50'000'000) + "\n");
  expectMotion(read("VID_1_gyro.csv"), 0.05);
  expectMotion(read(""), 0.05);
  // As the app names them since it has records of the magnetic field.
  for (const char* sensor : {"gyro", "accel"})
    fs::rename(folder_ / ("VID_1_" + std::string(sensor) + ".csv"),
               folder_ / ("VID_1" + std::string(sensor) + ".csv"));
  write("VID_1magnetic.csv", "1,2,3,4\n");
  fs::rename(folder_ / "VID_1_timestamps.csv", folder_ / "VID_1_imu_timestamps.csv");
  expectMotion(read("VID_1gyro.csv"), 0.05);
  expectMotion(read(""), 0.05);
}

/// The first was found by fuzzing.
TEST_F(ImuTableTest, RowsThatDoNotFitAreNamed) {
  write("v_gyro.csv", "0.1,0.2,3\n");
  write("v_accel.csv", "0,9.8,0,1000\n");
  write("v_timestamps.csv", "1000\n");
  expectError("v_gyro.csv", "v_gyro.csv:1: has 3 columns instead of 4");
  write("v_gyro.csv", "0.1,0.2,0.3,9000000000000000000\n");
  expectError("v_gyro.csv", "v_gyro.csv:1: '9000000000000000000' is no time in ns");
  write("v_gyro.csv", "0.1,0.2,0.3,5\n");
  expectError("v_gyro.csv", "has no time in common");
  writeSensorLogger("android,false", 1);
  EXPECT_TRUE(warns(read("", "9999999999999.mp4"), "is taken to begin with the recording"));
}

TEST_F(ImuTableTest, GyroflowsScalesAndOrientationCount) {
  const std::string header =
      "GYROFLOW IMU LOG\nversion,1.3\nid,custom_logger_name\norientation,YxZ\ntscale,0.001\n"
      "gscale,0.5\nascale,0.00048828125\nt,gx,gy,gz,ax,ay,az\n";
  write("v.gcsv", header + "0,2,4,6,0,0,2048\n1,2,4,6,0,0,2048\n2,2,4,6,-2048,0,0\n");
  const ImuTable table = read("v.gcsv");
  ASSERT_EQ(table.samples.size(), 3u);
  EXPECT_EQ(toUtime(table.samples[2].time), 2'000);
  // Y, -x, Z of (1, 2, 3) rad/s; one g along z, then along -x.
  EXPECT_LT((table.samples[0].gyro - Eigen::Vector3d(2, -1, 3)).norm(), 1e-12);
  EXPECT_LT((table.samples[0].accel - Eigen::Vector3d(0, 0, 9.80665)).norm(), 1e-9);
  EXPECT_LT((table.samples[2].accel - Eigen::Vector3d(0, 9.80665, 0)).norm(), 1e-9);
  EXPECT_TRUE(warns(table, "turned by its orientation YxZ"));
  const auto replaced = [&](const std::string& what, const std::string& by) {
    std::string text = header;
    write("v.gcsv", text.replace(text.find(what), what.size(), by) + "0,2,4,6,0,0,2048\n");
  };
  replaced("YxZ", "XXZ");
  expectError("v.gcsv", "v.gcsv:4: orientation 'XXZ' repeats an axis");
  replaced("0.5", "-1");
  expectError("v.gcsv", "v.gcsv:6: gscale: must be above 0");
  replaced(",ax,ay,az", "");
  expectError("v.gcsv", "without an accelerometer");
}

/// The example of the format's documentation: its ascale gives m/s^2.
TEST_F(ImuTableTest, AScaleInAnotherUnitIsSeen) {
  write("v.gcsv",
        "GYROFLOW IMU "
        "LOG\nversion,1\nid,custom_logger_name\norientation,XYZ\nnote,FIRMWARE_0.1.0\ntscale,0.001\n"
        "gscale,0.0002663161\nascale,0.00059875488\nt,gx,gy,gz,ax,ay,az\n0,39,86,183,-1137,-15689,-2986\n"
        "1,56,100,202,-1179,-15694,-2887\n2,63,108,218,-1247,-15702,-2794\n");
  const ImuTable table = read("v.gcsv");
  EXPECT_NEAR(table.samples[0].accel.norm(), 9.6, 0.1);
  EXPECT_TRUE(warns(table, "ascale gives m/s^2"));
}

/// ESP loggers write "xyz" where nobody has set another.
TEST_F(ImuTableTest, AMirroringOrientationLeavesTheAxesAsTheyAre) {
  write(
      "v.gcsv",
      "GYROFLOW IMU LOG\nversion,1.1\nid,esplog\norientation,xyz\ntscale,0.00180\ngscale,0.00053263221\n"
      "ascale,0.00048828125\nt,gx,gy,gz,ax,ay,az\n1,-38,4,12,-142,-411,-2160\n2,-40,4,13,-142,-411,-2160\n");
  const ImuTable table = read("v.gcsv");
  EXPECT_NEAR(table.samples[0].accel.z(), -2160 * 0.00048828125 * 9.80665, 1e-9);
  EXPECT_NEAR(table.samples[0].gyro.x(), -38 * 0.00053263221, 1e-9);
  EXPECT_TRUE(warns(table, "orientation xyz would mirror the axes"));
  EXPECT_FALSE(warns(table, "are turned by"));
}

/// As of RunCam's Thumb with the firmware 2.0.0.
TEST_F(ImuTableTest, ColumnsOfAGcsvThatAreSwappedAreReadSo) {
  const std::string rows =
      "1,-4239,-14,840,-405,81,22\n2,-4239,-14,840,-405,81,22\n3,-4238,-13,836,-409,70,17\n";
  const std::string header =
      "GYROFLOW IMU LOG\nversion,1.1\nid,runcam_thumb\norientation,XYZ\ntscale,0.001\ngscale,0.00054541539\n"
      "ascale,0.00024414062\nt,rx,ry,rz,ax,ay,az\n";
  write("v.gcsv", header + rows);
  const ImuTable table = read("v.gcsv");
  EXPECT_NEAR(table.samples[0].gyro.x(), -405 * 0.00054541539, 1e-9);
  EXPECT_NEAR(table.samples[0].accel.x(), -4239 * 0.00024414062 * 9.80665, 1e-6);
  EXPECT_EQ(table.units.accel, "g");
  EXPECT_TRUE(warns(table, "gravity stands in the gyro's columns"));
  // The same from a firmware that has them right.
  write("v.gcsv", header + "1,-405,81,22,-4239,-14,840\n2,-409,70,17,-4238,-13,836\n");
  EXPECT_FALSE(warns(read("v.gcsv"), "swapped"));
}

TEST_F(ImuTableTest, AVideoTakesAPhonesFolder) {
  VideoWriter writer(folder_ / "v.mp4", {96, 64}, 25);
  for (int k = 0; k < 30; ++k) writer.write(texture(96, 64, k, 1));
  writer.close();
  writeSensorLogger("android,false", 1);
  ImportOptions options;
  options.source = folder_ / "v.mp4";
  options.log = folder_ / "v.lcm";
  options.imu = folder_.path();
  Progress progress("importing", "frames", true);
  EXPECT_EQ(importRecording(videoImporter(), options, progress).imu_samples, kSamples - 1);
  // The checks of every importer.
  write("TotalAcceleration.csv", "time,seconds_elapsed,z,y,x\n" + rows("N,S,0,0.1,0", kStart_ns, 3'000'000));
  fs::remove(options.log);
  EXPECT_NE(errorMessageOf([&] {
              importRecording(videoImporter(), options, progress);
            }).find("linear acceleration"),
            std::string::npos);
}

}  // namespace
}  // namespace redbee::test
