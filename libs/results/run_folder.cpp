#include "redbee/results/run_folder.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/json_file.hpp"
#include "redbee/results/png_file.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

/// std::nullopt if the name is not that of a map.
std::optional<int64_t> timeOf(const fs::path& file) {
  const std::string stem = file.stem().string();
  int64_t utime = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), utime);
  const bool whole = error == std::errc() && end == stem.data() + stem.size();
  return whole && file.extension() == ".png" ? std::optional<int64_t>(utime) : std::nullopt;
}

}  // namespace

fs::path RunFolder::folder(RunMap map) const {
  return path_ / (map == RunMap::kProbability ? "probability" : "mask");
}

std::string nameOfFrame(int64_t utime) { return fmt::format("{:016}", utime); }

fs::path RunFolder::file(RunMap map, int64_t utime) const {
  return folder(map) / (nameOfFrame(utime) + ".png");
}

fs::path RunFolder::existing(RunMap map, int64_t utime) const {
  const fs::path unpadded = folder(map) / (std::to_string(utime) + ".png");  // of releases up to 0.2
  return !fs::exists(file(map, utime)) && fs::exists(unpadded) ? unpadded : file(map, utime);
}

void RunFolder::prepare() const {
  for (const RunMap map : {RunMap::kProbability, RunMap::kMask}) {
    std::error_code error;
    fs::create_directories(folder(map), error);
    if (error) throw InputError(folder(map), error.message());
    std::vector<fs::path> earlier;
    for (const auto& entry : fs::directory_iterator(folder(map))) {
      if (entry.path().extension() == ".png") earlier.push_back(entry.path());
    }
    for (const fs::path& file : earlier) fs::remove(file);
  }
}

std::vector<int64_t> RunFolder::times(RunMap map) const {
  if (!fs::is_directory(folder(map))) throw InputError(folder(map), "no such folder");
  std::vector<int64_t> times;
  for (const auto& entry : fs::directory_iterator(folder(map))) {
    if (const auto utime = timeOf(entry.path())) times.push_back(*utime);
  }
  std::sort(times.begin(), times.end());
  return times;
}

bool RunFolder::has(RunMap map, int64_t utime) const { return fs::exists(existing(map, utime)); }

cv::Mat1b RunFolder::read(RunMap map, int64_t utime) const { return readGreyPng(existing(map, utime)); }

cv::Mat1b RunFolder::readOrZeros(RunMap map, int64_t utime, cv::Size size) const {
  if (!has(map, utime)) return cv::Mat1b::zeros(size);
  cv::Mat1b image = read(map, utime);
  if (image.size() != size) {
    throw InputError(existing(map, utime),
                     "has " + std::to_string(image.cols) + "x" + std::to_string(image.rows) +
                         " px instead of " + std::to_string(size.width) + "x" + std::to_string(size.height));
  }
  return image;
}

void RunFolder::write(RunMap map, int64_t utime, std::string_view png) const {
  writeAtomically(file(map, utime), png);
}

void RunFolder::writeSummary(const nlohmann::json& summary) const {
  writeJson(path_ / "summary.json", summary);
}

nlohmann::json RunFolder::summary() const { return readJson(path_ / "summary.json"); }

}  // namespace redbee
