#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "processes/serve/frame_view.hpp"
#include "processes/serve/station.hpp"

namespace redbee {
namespace {

constexpr int64_t kDeepestZoom = 22;

}  // namespace

/// [13, 14, ...]: the levels that there are; empty without tiles.
WebResponse Station::tileLevels(const WebRequest&) {
  std::vector<int64_t> levels;
  std::error_code error;
  auto at = std::filesystem::directory_iterator(tiles_, error);
  for (; !error && at != std::filesystem::directory_iterator(); at.increment(error)) {
    const auto level = numberOf(at->path().filename().string());
    if (level && *level <= kDeepestZoom) levels.push_back(*level);
  }
  std::sort(levels.begin(), levels.end());
  WebResponse response;
  response.type = "application/json";
  response.body = nlohmann::json(levels).dump();
  return response;
}

/// Three numbers become the path, and nothing else of the request does.
WebResponse Station::tile(const WebRequest& request) {
  const auto z = numberOf(request.parameter("z"));
  const auto x = numberOf(request.parameter("x"));
  const auto y = numberOf(request.parameter("y"));
  WebResponse response;
  response.status = 400;
  response.body = "z, x, y: must be the numbers of a tile\n";
  if (!z || !x || !y || *z > kDeepestZoom || *x >> *z != 0 || *y >> *z != 0) return response;
  const auto file = tiles_ / std::to_string(*z) / std::to_string(*x) / (std::to_string(*y) + ".png");
  std::error_code error;
  const auto bytes =
      std::filesystem::is_regular_file(file, error) ? std::filesystem::file_size(file, error) : 0;
  response.status = tiles_.empty() || error || bytes == 0 ? 404 : 200;
  response.body = "no such tile\n";
  if (response.status != 200) return response;
  response.type = "image/png";
  response.file = file;
  response.file_bytes = bytes;
  return response;
}

}  // namespace redbee
