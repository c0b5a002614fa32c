#include "redbee/importers/recognise.hpp"

#include <array>
#include <fstream>
#include <string_view>

#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/importers/data_track.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

/// By its first event, or by its name where that is damaged.
bool isLog(const fs::path& file) {
  std::array<char, 4> bytes{};
  requireFile(file);
  std::ifstream(file, std::ios::binary).read(bytes.data(), bytes.size());
  return std::string_view(bytes.data(), bytes.size()) == "\xED\xA1\xDA\x01" || file.extension() == ".lcm";
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
  if (!fs::exists(path)) throw InputError(path, "no such file or folder");
  if (fs::is_directory(path)) {
    const bool is_asl = fs::is_directory(path / "mav0") || fs::is_directory(path / "cam0");
    return is_asl ? "asl" : "video";
  }
  if (isLog(path)) return "";
  return hasMotionTrack(path) ? "gopro" : "video";
}

}  // namespace redbee
