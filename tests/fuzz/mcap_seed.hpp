// Seeds for the MCAP importer and for the messages in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "processes/redbee/export/ros_export.hpp"
#include "processes/redbee/export/ros_schemas.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/files/mcap_writer.hpp"
#include "tests/bus/sample_messages.hpp"
#include "tests/support/mcap_bytes.hpp"

namespace redbee::fuzz {

struct ExportedMessage {
  std::string name;
  uint8_t
      ros_pick;  ///< the first byte of ros_fuzz.cpp's input: place of the type, times two, plus one for CDR
  McapSchema schema;
  std::vector<uint8_t> bytes;

  std::vector<uint8_t> rosSeed() const {
    std::vector<uint8_t> seed{ros_pick};
    seed.insert(seed.end(), bytes.begin(), bytes.end());
    return seed;
  }
};

inline std::vector<ExportedMessage> exportedMessages(const CameraIntrinsics& camera) {
  const cv::Mat1b grey(8, 8, uint8_t{90});
  return {{"raw_image", 11, rawImageSchema(), exportRawImage(rawGreyMessage(1'000'000, grey))},
          {"jpeg", 13, compressedImageSchema(),
           exportCompressedImage(1'100'000, jpegMessage(0, grey, 90).data, "jpeg")},
          {"imu", 5, imuSchema(), exportImu(test::sample<ins_t>())},
          {"range", 7, rangeSchema(), exportRange(test::sample<altimeter_t>())},
          {"camera_info", 9, cameraInfoSchema(), exportCameraInfo(1'000'000, camera)}};
}

/// Without the message at `left_out`: one topic of images is enough.
inline void writeMcapFile(const std::filesystem::path& file, const std::vector<ExportedMessage>& messages,
                          size_t left_out) {
  std::filesystem::create_directories(file.parent_path());
  McapWriter writer(file, "ros2", "seed");
  for (size_t i = 0; i < messages.size(); ++i) {
    if (i == left_out) continue;
    const uint16_t channel = writer.addChannel("/" + messages[i].name, messages[i].schema, "cdr");
    for (int k = 0; k < 3; ++k) writer.write(channel, 1000 * k, messages[i].bytes);
  }
  writer.close();
}

/// Neither compressed nor protected by a CRC, so that a search gets through to the messages.
inline std::string mcapWithoutChunks(const std::vector<ExportedMessage>& messages, size_t left_out) {
  std::string file = test::mcapHeader();
  for (size_t i = 0; i < messages.size(); ++i) {
    if (i == left_out) continue;
    const auto id = static_cast<uint16_t>(i + 1);
    file += test::mcapSchema(id, messages[i].schema.name) +
            test::mcapChannel(id, id, "/" + messages[i].name) +
            test::mcapMessage(id, 0, {messages[i].bytes.begin(), messages[i].bytes.end()});
  }
  return file + test::mcapRecord(McapRecord::kDataEnd, std::string(4, '\0'));
}

}  // namespace redbee::fuzz
