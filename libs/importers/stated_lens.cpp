#include "redbee/importers/stated_lens.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

constexpr double kFilm_mm = 36;      // width
constexpr double kUsual_mm = 28.8;   // equivalent of a camera whose sensor is not known: assumeIntrinsics()
constexpr double kZooms = 1.002;     // what differs by less is rounded
constexpr int kLensWidth_px = 3600;  // of LENS: any will do
constexpr double kPerMm = kLensWidth_px / kFilm_mm;
constexpr double kLongest_mm = 10000;  // equivalent; what is longer is no focal length

/// The number behind `name`, a colon and blanks, with its text; std::nullopt if there is none.
struct Stated {
  double value;
  bool is_whole;  ///< has no decimal point
};
std::optional<Stated> statedAs(const std::string& name, const std::string& line) {
  for (size_t at = line.find(name); at != std::string::npos; at = line.find(name, at + 1)) {
    const bool is_start =
        at == 0 || (std::isalnum(static_cast<unsigned char>(line[at - 1])) == 0 && line[at - 1] != '_');
    const size_t colon = line.find_first_not_of(' ', at + name.size());
    if (!is_start || colon == std::string::npos || line[colon] != ':') continue;
    const char* begin = line.c_str() + colon + 1;
    char* end = nullptr;
    const double value = std::strtod(begin, &end);
    if (end == begin || !std::isfinite(value)) continue;
    return Stated{value, std::find(begin, static_cast<const char*>(end), '.') == end};
  }
  return std::nullopt;
}

/// `HH:MM:SS,mmm --> ...`, in us.
std::optional<int64_t> startOf(const std::string& line) {
  int hours = 0, minutes = 0, seconds = 0, milliseconds = 0;
  if (line.find("-->") == std::string::npos) return std::nullopt;
  if (std::sscanf(line.c_str(), "%d:%d:%d,%d", &hours, &minutes, &seconds, &milliseconds) != 4)
    return std::nullopt;
  const auto isIn = [](int value, int end) { return value >= 0 && value < end; };
  if (!isIn(hours, 100) || !isIn(minutes, 60) || !isIn(seconds, 60) || !isIn(milliseconds, 1000))
    return std::nullopt;
  return ((hours * int64_t{60} + minutes) * 60 + seconds) * 1000000 + milliseconds * int64_t{1000};
}

std::optional<double> equivalentOf(const std::string& text) {
  const auto focal = statedAs("focal_len", text);
  if (!focal) return std::nullopt;
  double mm = focal->is_whole ? focal->value / 10 : focal->value;
  if (const auto crop = statedAs("dzoom_ratio", text)) {
    mm *= crop->is_whole && crop->value >= 1000 ? crop->value / 10000 : crop->value;
  } else if (const auto zoom = statedAs("zoom", text)) {
    mm *= zoom->value;
  }
  return mm > 0 && mm < kLongest_mm ? std::optional(mm) : std::nullopt;
}

}  // namespace

std::vector<EquivalentFocalLength> readDjiSubtitles(const std::filesystem::path& file) {
  requireFile(file);
  std::ifstream in(file);
  std::vector<EquivalentFocalLength> found;
  std::optional<int64_t> start;
  std::string text;
  const auto finish = [&] {
    const auto mm = equivalentOf(text);
    if (start && mm && (found.empty() || *start > found.back().utime)) found.push_back({*start, *mm});
    text.clear();
  };
  for (std::string line; std::getline(in, line);) {
    if (const auto time = startOf(line)) {
      finish();
      start = time;
    } else {
      text += line + ' ';
    }
  }
  finish();
  if (in.bad()) throw InputError(file, "cannot be read");
  return found;
}

std::optional<std::filesystem::path> subtitlesBeside(const std::filesystem::path& video) {
  for (const char* extension : {".SRT", ".srt"}) {
    std::filesystem::path file = video;
    file.replace_extension(extension);
    if (faultOfFile(file).empty()) return file;
  }
  return std::nullopt;
}

void LensRecord::add(const EquivalentFocalLength& focal, FlightMerger& merger) {
  if (first_mm_ == 0) first_mm_ = shortest_mm_ = longest_mm_ = focal.mm;
  shortest_mm_ = std::min(shortest_mm_, focal.mm);
  longest_mm_ = std::max(longest_mm_, focal.mm);
  merger.addLens({ImuTime(fromUtime(focal.utime)), kPerMm * focal.mm, kLensWidth_px});
}

void LensRecord::add(int64_t utime, const ExifLens& lens, FlightMerger& merger) {
  // The equivalent is rounded to a millimetre: it gives the first one, the lens's own the proportion.
  const double stated = lens.focal_mm.value_or(lens.equivalent_mm.value_or(0)) * lens.digital_zoom;
  if (!(stated > 0) || !(stated < kLongest_mm)) return;
  if (first_stated_ == 0) first_stated_ = stated;
  const double first_mm = first_mm_ > 0 ? first_mm_ : lens.equivalent_mm.value_or(kUsual_mm);
  add({utime, first_mm * stated / first_stated_}, merger);
}

void LensRecord::describe(ImportSummary& summary) const {
  if (first_mm_ == 0) return;
  const double px = first_mm_ / kFilm_mm * summary.vehicle.width;
  if (longest_mm_ > kZooms * shortest_mm_) summary.vehicle.lens_focal_px = px;
}

}  // namespace redbee
