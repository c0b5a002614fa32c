#include "processes/serve/frame_view.hpp"

#include <nlohmann/json.hpp>

#include "processes/serve/map_json.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/image_codec/jpeg.hpp"

namespace redbee {
namespace {

using nlohmann::json;
constexpr int kJpegQuality = 90;  ///< of images that the camera gives raw

const char* statusText(int8_t status) {
  switch (status) {
    case foreground_t::GOOD:
      return "good";
    case foreground_t::LEARNING:
      return "learning the background";
    case foreground_t::NO_HOMOGRAPHY:
      return "no homography: the ground is not seen";
    default:
      return "the image is bad";
  }
}

json detectionsJson(const detections_t& detections) {
  json result = json::array();
  for (const detection_t& d : detections.detections) {
    result.push_back({{"id", d.id},
                      {"x", d.x},
                      {"y", d.y},
                      {"width", d.width},
                      {"height", d.height},
                      {"area", d.area},
                      {"score", d.score},
                      {"seen", d.seen != 0}});
  }
  return result;
}

json trailsJson(const std::vector<Trail>& trails) {
  json result = json::array();
  for (const Trail& trail : trails)
    result.push_back({{"id", trail.id}, {"points", pointsJson(trail.points)}});
  return result;
}

/// A JPEG goes as it came. Empty for an image that cannot be decoded.
std::vector<uint8_t> jpegOf(const image_t& image) {
  if (image.pixelformat == image_t::MJPEG) {
    if (jpegSize(image.data.data(), image.data.size())) return image.data;
    return {};
  }
  const auto colour = decodeColour(image);
  return colour ? encodeJpeg(*colour, kJpegQuality) : std::vector<uint8_t>();
}

}  // namespace

std::string textOf(const json& json) { return json.dump(-1, ' ', false, json::error_handler_t::replace); }

std::string bundleOf(const json& head, const std::vector<uint8_t>& image, const std::vector<uint8_t>& mask) {
  const std::string text = textOf(head);
  std::string bundle;
  bundle.reserve(4 + text.size() + image.size() + mask.size());
  for (const int shift : {24, 16, 8, 0}) bundle += static_cast<char>(text.size() >> shift & 0xff);
  bundle += text;
  bundle.append(image.begin(), image.end());
  bundle.append(mask.begin(), mask.end());
  return bundle;
}

std::string bundleOf(const FrameView& view, int64_t sequence) {
  std::vector<uint8_t> jpeg;
  cv::Size size;
  std::string note = view.note;
  if (view.image) {
    jpeg = jpegOf(*view.image);
    size = declaredSize(*view.image);
    if (jpeg.empty()) note = "the image cannot be shown: " + faultOfImage(*view.image);
  }
  json head{{"sequence", sequence},  {"utime", view.utime},        {"width", size.width},
            {"height", size.height}, {"image_bytes", jpeg.size()}, {"mask_bytes", view.mask.size()},
            {"note", note},          {"source", view.source}};
  if (view.map) head["map"] = mapJson(*view.map);
  if (view.detections) {
    head["status"] = statusText(view.detections->status);
    head["detections"] = detectionsJson(*view.detections);
    head["trails"] = trailsJson(view.trails);
  }
  return bundleOf(head, jpeg, view.mask);
}

}  // namespace redbee
