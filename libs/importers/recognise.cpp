#include "redbee/importers/recognise.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/files/mcap_format.hpp"
#include "redbee/importers/data_track.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

std::string startOf(const fs::path& file) {
  std::string bytes(16, '\0');
  requireFile(file);
  std::ifstream(file, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

bool startsWith(const std::string& text, std::string_view start) {
  return text.compare(0, start.size(), start) == 0;
}

/// A folder that rosbag2 has recorded.
bool isRosBag(const fs::path& folder) {
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(), [](const auto& entry) {
    fs::path name = entry.path().filename();
    if (name.extension() == ".zstd") name = name.stem();
    return name.extension() == ".mcap" || name.extension() == ".db3";
  });
}

bool hasMotionTrack(const fs::path& file) {
  try {
    return !readDataTrack(file, "gpmd").empty();
  } catch (const InputError&) {
    return false;  // the importer of videos says what is wrong
  }
}

}  // namespace

std::string recogniseRecording(const fs::path& path) {
  if (!fs::exists(path)) throw InputError(path, isAddress(path) ? kAddressFault : "no such file or folder");
  if (fs::is_directory(path)) {
    const bool is_asl = fs::is_directory(path / "mav0") || fs::is_directory(path / "cam0");
    if (is_asl) return "asl";
    return isRosBag(path) ? "mcap" : "video";
  }
  const std::string kind = recogniseStart(path);
  return kind == "video" && hasMotionTrack(path) ? "gopro" : kind;
}

std::string recogniseStart(const fs::path& path) {
  const std::string start = startOf(path);
  // By its first event, or by its name where that is damaged.
  if (startsWith(start, "\xED\xA1\xDA\x01") || path.extension() == ".lcm") return "";
  if (startsWith(start, {reinterpret_cast<const char*>(kMcapMagic.data()), kMcapMagic.size()})) return "mcap";
  if (startsWith(start, "#ROSBAG V") || path.extension() == ".bag") return "rosbag";
  return "video";
}

}  // namespace redbee
