#include "redbee/importers/ros/ros_encodings.hpp"

#include <algorithm>
#include <array>

#include "redbee/bus/raw_format.hpp"

namespace redbee {
namespace {

struct Encoding {
  const char* ros;
  const char* format;  ///< as raw_format.hpp names it
};

/// Of several encodings of a format the first is written.
constexpr std::array<Encoding, 16> kEncodings{{{"mono8", "GRAY"},
                                               {"8UC1", "GRAY"},
                                               {"rgb8", "RGB"},
                                               {"bgr8", "BGR"},
                                               {"8UC3", "BGR"},
                                               {"rgba8", "RGBA"},
                                               {"bgra8", "BGRA"},
                                               {"8UC4", "BGRA"},
                                               {"yuyv", "YUYV"},
                                               {"yuv422_yuy2", "YUYV"},
                                               {"uyvy", "UYVY"},
                                               {"yuv422", "UYVY"},
                                               {"bayer_bggr8", "BAYER_BGGR"},
                                               {"bayer_gbrg8", "BAYER_GBRG"},
                                               {"bayer_grbg8", "BAYER_GRBG"},
                                               {"bayer_rggb8", "BAYER_RGGB"}}};

}  // namespace

int32_t pixelFormatOf(const std::string& ros_encoding) {
  const auto* found = std::find_if(kEncodings.begin(), kEncodings.end(),
                                   [&](const Encoding& row) { return row.ros == ros_encoding; });
  return found == kEncodings.end() ? 0 : formatNamed(found->format);
}

std::string rosEncodings() {
  std::string names;
  for (const Encoding& row : kEncodings) names += (names.empty() ? "" : ", ") + std::string(row.ros);
  return names;
}

std::string rosEncodingOf(int32_t pixelformat) {
  const std::string name = formatName(pixelformat);
  if (name == "LE_GRAY16") return "mono16";  // read by its 16 bits, not as a format
  const auto* found = std::find_if(kEncodings.begin(), kEncodings.end(),
                                   [&](const Encoding& row) { return row.format == name; });
  return found == kEncodings.end() ? "" : found->ros;
}

}  // namespace redbee
