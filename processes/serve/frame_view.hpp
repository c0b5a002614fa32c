// One frame as the page shows it, live or from a flight on disk, and its bytes on the way to the browser.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "processes/serve/map_view.hpp"
#include "processes/serve/trails.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/image_t.hpp"

namespace redbee {

struct FrameView {
  int64_t utime = 0;                       ///< us, of the image
  std::shared_ptr<const image_t> image;    ///< may be null
  std::optional<detections_t> detections;  ///< of this very frame
  std::vector<uint8_t> mask;               ///< PNG, 255 moving, on the raw image's grid; may be empty
  std::vector<Trail> trails;               ///< where there are detections
  std::string source;          ///< of the ground's homography: "fused", "visual", ...; may be empty
  std::string note;            ///< what is missing, in words; empty: nothing
  std::optional<MapView> map;  ///< of a flight on disk; the live one comes by itself (live_map.hpp)
};

/// Four bytes, big-endian: the length of the JSON that follows; then the image (JPEG), then the mask (PNG),
/// whose lengths the JSON states. The JSON has DETECTIONS member for member. An image that cannot be decoded
/// is left out and said in `note`.
std::string bundleOf(const FrameView& view, int64_t sequence);

/// The same with another JSON, which states image_bytes and mask_bytes.
std::string bundleOf(const nlohmann::json& head, const std::vector<uint8_t>& image,
                     const std::vector<uint8_t>& mask);

/// Bad UTF-8, which a message may hold, is replaced.
std::string textOf(const nlohmann::json& json);

}  // namespace redbee
