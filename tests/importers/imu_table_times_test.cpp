// Tables whose times cannot be true, and names that are not for a terminal.
#include "tests/importers/imu_table_fixture.hpp"

namespace redbee::test {
namespace {

TEST_F(ImuTableTest, ARowYearsAheadCostsItself) {
  writeSensorLogger("android,false", 1);
  const std::string file = readText(folder_ / "Gyroscope.csv");
  const std::string time = std::to_string(kStart_ns + 100 * kPeriod_ns + 1'000'000);
  std::string changed = file;
  write("Gyroscope.csv", changed.replace(file.find(time), 2, "20"));
  const ImuTable table = read("");
  expectMotion(table, 0, kSamples - 3);
  EXPECT_TRUE(warns(table, "Gyroscope.csv: 1 of 300 times leap, the first (number 101) by 300000000.0"));
}

TEST_F(ImuTableTest, APauseIsNoLeap) {
  writeSensorLogger("android,false", 1);
  // A phone's sensors pause while the app is in the background; the last samples are few.
  for (const char* name : {"Gyroscope.csv", "TotalAcceleration.csv"}) {
    std::string file = readText(folder_ / name);
    const bool is_gyro = name[0] == 'G';
    for (int k = 0; k < 3; ++k)
      file += std::to_string(kStart_ns + 100'000'000'000 + k * kPeriod_ns) +
              (is_gyro ? ",100,0.1,0,0\n" : ",100,0,9.8,0\n");
    write(name, file);
  }
  const ImuTable table = read("");
  EXPECT_GE(table.samples.size(), size_t{kSamples + 1});
  EXPECT_GT(toUtime(table.samples.back().time), 99'000'000);
  EXPECT_FALSE(warns(table, "leap"));
}

TEST_F(ImuTableTest, TimesThatRunBackwardsAreRefused) {
  writeSensorLogger("android,false", 1);
  const std::string header = "time,seconds_elapsed,z,y,x\n";
  write("Gyroscope.csv",
        header + rows("N,S,G,0,0", kStart_ns, 1'000'000) + rows("N,S,G,0,0", kStart_ns, 2'000'000));
  expectError("", "Gyroscope.csv: 299 of 600 times run backwards");
}

TEST_F(ImuTableTest, NamesOfColumnsAreEscapedAndTheFirstTenListed) {
  std::string header = "Timestamp[nanosec],\x1b[31mred";
  for (int i = 3; i < 25; ++i) header += ",c" + std::to_string(i);
  write("gyro_accel.csv", header + "\n");
  write("frame_timestamps.txt", "1\n");
  expectError("gyro_accel.csv",
              "(found: Timestamp[nanosec] \\x1b[31mred c3 c4 c5 c6 c7 c8 c9 c10 and 14 more)");
}

}  // namespace
}  // namespace redbee::test
