// IMU recordings of phones with any content. Input: gyro (or the one table there is), accelerometer, frame
// times, cut by lines of "%%"; read as each app's files.
#include "redbee/files/input_error.hpp"
#include "redbee/importers/imu_table.hpp"
#include "tests/fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const fuzz::Folder folder;
  const auto contents = fuzz::parts(data, size, 3);
  const auto gyro = folder.write("v_gyro.csv", contents[0]);
  const auto logger = folder.write("Gyroscope.csv", contents[0]);
  for (const char* name : {"v_accel.csv", "TotalAcceleration.csv"}) folder.write(name, contents[1]);
  for (const char* name : {"v_timestamps.csv", "frame_timestamps.txt", "Metadata.csv"})
    folder.write(name, contents[2]);
  for (const auto& file : {gyro, logger}) {
    try {
      readImuTable(file, "1600000000000.mp4", {});
    } catch (const InputError&) {
    }
  }
  return 0;
}
