// Recordings in MCAP with images and an IMU, as ROS 2's messages.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "processes/redbee/export/ros_export.hpp"
#include "processes/redbee/export/ros_schemas.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/files/mcap_writer.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/sensor_messages.hpp"

namespace redbee::test {

using PackMessage = std::function<std::vector<uint8_t>(const std::vector<uint8_t>&)>;

/// Frames number `first` and on at 20 Hz, 64x48 px, the first of all at 1 s.
inline void writeMcapRecording(
    const std::filesystem::path& file, int first, int frames, const std::vector<ImuSample>& imu,
    const PackMessage& pack = [](const std::vector<uint8_t>& bytes) { return bytes; }) {
  std::filesystem::create_directories(file.parent_path());
  McapWriter writer(file, "ros2", "test");
  const uint16_t images = writer.addChannel("/camera", rawImageSchema(), "cdr");
  const uint16_t samples = writer.addChannel("/imu", imuSchema(), "cdr");
  for (int k = first; k < first + frames; ++k) {
    const int64_t utime = 1'000'000 + 50'000 * k;
    writer.write(images, 1000 * utime, pack(exportRawImage(rawGreyMessage(utime, texture(64, 48, k, 1)))));
  }
  for (const ImuSample& sample : imu)
    writer.write(samples, 1000 * toUtime(sample.time), pack(exportImu(message(sample))));
  writer.close();
}

}  // namespace redbee::test
