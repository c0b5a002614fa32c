// What a recording is.
#pragma once

#include <filesystem>
#include <string>

namespace redbee {

/// The name of the importer that reads it ("asl", "gopro", "mcap", "rosbag" or "video"), by its content;
/// empty for an LCM log, which needs none. Throws InputError if there is no such file or folder.
std::string recogniseRecording(const std::filesystem::path& path);
/// Of a file, by its first bytes and its name alone: as above, and "video" for all else.
std::string recogniseStart(const std::filesystem::path& file);

}  // namespace redbee
