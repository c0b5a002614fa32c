// The packets of a data track beside a video, such as a GoPro's metadata.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace redbee {

struct DataPacket {
  double start_s = 0;  ///< on the video's clock: what an edit list cuts off lies before 0
  double duration_s = 0;
  std::vector<uint8_t> bytes;
};

/// All packets of the data track with this four-letter tag ("gpmd"); empty if there is no such track. Throws
/// InputError if the file is not a media container or is truncated.
std::vector<DataPacket> readDataTrack(const std::filesystem::path& path, const std::string& tag);

}  // namespace redbee
