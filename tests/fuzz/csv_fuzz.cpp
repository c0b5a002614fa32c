// Text that a user hands over: an IMU or subtitles beside a video, corners and IMU of a calibration target.
#include "processes/redbee/calibrate/calibration_target_csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/importers/imu_csv.hpp"
#include "redbee/importers/stated_lens.hpp"
#include "tests/fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const fuzz::Folder folder;
  const auto file = folder.write("table.csv", std::string(reinterpret_cast<const char*>(data), size));
  const auto attempt = [&](const auto& read) {
    try {
      read(file);
    } catch (const InputError&) {
    }
  };
  attempt([](const auto& f) { return readImuCsv(f); });
  attempt([](const auto& f) { return readTargetCorners(f); });
  attempt([](const auto& f) { return readTargetImu(f); });
  attempt([](const auto& f) { return readDjiSubtitles(f); });
  return 0;
}
