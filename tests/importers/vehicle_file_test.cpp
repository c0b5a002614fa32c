#include "processes/redbee/vehicle/vehicle_file.hpp"

#include <gtest/gtest.h>

#include "redbee/configuration/configuration.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

VehicleDescription vehicleOf(int width, int height, bool has_imu) {
  VehicleDescription vehicle;
  vehicle.name = "v";
  vehicle.width = width;
  vehicle.height = height;
  vehicle.has_imu = has_imu;
  vehicle.intrinsics = CameraIntrinsics{};
  vehicle.intrinsics->width = width;
  vehicle.intrinsics->height = height;
  vehicle.intrinsics->fx = vehicle.intrinsics->fy = width;
  vehicle.intrinsics->cx = width / 2.0;
  vehicle.intrinsics->cy = height / 2.0;
  return vehicle;
}

TEST(VehicleFileTest, AnEarlierFileIsComparedWithTheRecording) {
  const ScratchFolder folder;
  const fs::path file = writeVehicleFile(vehicleOf(320, 240, false), folder / "f.lcm");
  EXPECT_EQ(compareVehicleFile(file, vehicleOf(320, 240, false)), "");
  EXPECT_NE(errorMessageOf([&] {
              compareVehicleFile(file, vehicleOf(640, 480, false));
            }).find("f.yaml: is of another camera: its images have 320x240 px, the recording's 640x480"),
            std::string::npos);
  EXPECT_NE(compareVehicleFile(file, vehicleOf(320, 240, true))
                .find("imu.present is false, but the recording has an IMU"),
            std::string::npos);
  writeText(file, "nonsense: [");
  EXPECT_THROW(compareVehicleFile(file, vehicleOf(320, 240, false)), ConfigurationError);
}

}  // namespace
}  // namespace redbee::test
