#include "redbee/bus/raw_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace redbee {
namespace {

constexpr int kAsItIs = -1;  ///< instead of a code of cv::cvtColor()

struct RawFormat {
  int32_t number;
  const char* name;
  int type;  ///< of the pixels as they are stored
  int to_grey;
  int to_bgr;
  bool is_planar_420 = false;  ///< U and V below Y: half as many rows again
  bool is_big_endian = false;
};

const std::array<RawFormat, 15>& rawFormats() {
  static const std::array<RawFormat, 15> all{{
      {image_t::GRAY, "GRAY", CV_8UC1, kAsItIs, cv::COLOR_GRAY2BGR},
      {image_t::RGB, "RGB", CV_8UC3, cv::COLOR_RGB2GRAY, cv::COLOR_RGB2BGR},
      {image_t::BGR, "BGR", CV_8UC3, cv::COLOR_BGR2GRAY, kAsItIs},
      {876758866, "RGBA", CV_8UC4, cv::COLOR_RGBA2GRAY, cv::COLOR_RGBA2BGR},
      {877807426, "BGRA", CV_8UC4, cv::COLOR_BGRA2GRAY, cv::COLOR_BGRA2BGR},
      {1448695129, "YUYV", CV_8UC2, cv::COLOR_YUV2GRAY_YUYV, cv::COLOR_YUV2BGR_YUYV},
      {1498831189, "UYVY", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY, cv::COLOR_YUV2BGR_UYVY},
      {808596553, "I420", CV_8UC1, cv::COLOR_YUV2GRAY_I420, cv::COLOR_YUV2BGR_I420, true},
      {842094158, "NV12", CV_8UC1, cv::COLOR_YUV2GRAY_NV12, cv::COLOR_YUV2BGR_NV12, true},
      // OpenCV names a mosaic by its second row.
      {825770306, "BAYER_BGGR", CV_8UC1, cv::COLOR_BayerRG2GRAY, cv::COLOR_BayerRG2BGR},
      {844650584, "BAYER_GBRG", CV_8UC1, cv::COLOR_BayerGR2GRAY, cv::COLOR_BayerGR2BGR},
      {861427800, "BAYER_GRBG", CV_8UC1, cv::COLOR_BayerGB2GRAY, cv::COLOR_BayerGB2BGR},
      {878205016, "BAYER_RGGB", CV_8UC1, cv::COLOR_BayerBG2GRAY, cv::COLOR_BayerBG2BGR},
      {909199180, "LE_GRAY16", CV_16UC1, kAsItIs, cv::COLOR_GRAY2BGR},
      {357, "BE_GRAY16", CV_16UC1, kAsItIs, cv::COLOR_GRAY2BGR, false, true},
  }};
  return all;
}

const RawFormat* findFormat(int32_t number) {
  const auto& all = rawFormats();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const RawFormat& f) { return f.number == number; });
  return found == all.end() ? nullptr : &*found;
}

/// The message's bytes as an image, without a copy.
std::optional<cv::Mat> viewRaw(const image_t& message, const RawFormat& format) {
  const bool is_halved = format.is_planar_420 || CV_MAT_CN(format.type) == 2;
  if (is_halved && message.width % 2 != 0) return std::nullopt;
  if (format.is_planar_420 && message.height % 2 != 0) return std::nullopt;
  const int64_t rows = format.is_planar_420 ? int64_t{message.height} * 3 / 2 : message.height;
  const int64_t row = int64_t{message.width} * static_cast<int64_t>(CV_ELEM_SIZE(format.type));
  if (message.row_stride < row || message.row_stride * rows != message.size) return std::nullopt;
  if (format.is_planar_420 && message.row_stride != row) return std::nullopt;
  if (message.row_stride % static_cast<int>(CV_ELEM_SIZE1(format.type)) != 0) return std::nullopt;
  // cv::Mat has no read-only view; the callers below only read.
  auto* data = const_cast<uint8_t*>(message.data.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  return cv::Mat(static_cast<int>(rows), message.width, format.type, data,
                 static_cast<size_t>(message.row_stride));
}

/// `view`: two bytes a pixel.
cv::Mat1b from16Bits(const cv::Mat& view, bool is_big_endian) {
  cv::Mat1w values(view.size());
  for (int y = 0; y < view.rows; ++y) {
    const uint8_t* bytes = view.ptr(y);
    uint16_t* row = values.ptr<uint16_t>(y);
    for (int x = 0; x < view.cols; ++x) {
      const int first = bytes[2 * x], second = bytes[2 * x + 1];
      row[x] = static_cast<uint16_t>(is_big_endian ? first << 8 | second : second << 8 | first);
    }
  }
  std::vector<uint16_t> sorted(values.begin(), values.end());
  constexpr size_t kOfThousand = 1;
  const size_t end = sorted.size() * kOfThousand / 1000;
  const auto at = [&](size_t place) {
    const auto position = sorted.begin() + static_cast<std::ptrdiff_t>(place);
    std::nth_element(sorted.begin(), position, sorted.end());
    return static_cast<double>(*position);
  };
  const double black = at(end);
  const double white = std::max(at(sorted.size() - 1 - end), black + 1);
  cv::Mat1b grey;
  values.convertTo(grey, CV_8U, 255 / (white - black), -255 * black / (white - black));
  return grey;
}

}  // namespace

std::optional<cv::Mat> decodeRaw(const image_t& message, bool colour) {
  const RawFormat* format = findFormat(message.pixelformat);
  if (format == nullptr) return std::nullopt;
  const auto view = viewRaw(message, *format);
  if (!view) return std::nullopt;
  const cv::Mat pixels =
      CV_MAT_DEPTH(format->type) == CV_16U ? from16Bits(*view, format->is_big_endian) : *view;
  const int code = colour ? format->to_bgr : format->to_grey;
  cv::Mat converted;
  if (code == kAsItIs) {
    pixels.copyTo(converted);
  } else {
    cv::cvtColor(pixels, converted, code);
  }
  return converted;
}

bool isRawFormat(int32_t pixelformat) { return findFormat(pixelformat) != nullptr; }

std::string readableFormats() {
  std::string names = "MJPEG";
  for (const RawFormat& format : rawFormats()) names += std::string(", ") + format.name;
  return names;
}

std::string formatName(int32_t pixelformat) {
  if (pixelformat == image_t::MJPEG) return "MJPEG";
  if (const RawFormat* format = findFormat(pixelformat)) return format->name;
  std::string letters;
  for (int shift = 0; shift < 32; shift += 8)
    letters += static_cast<char>(static_cast<uint32_t>(pixelformat) >> shift & 0xFF);
  const bool is_text = std::all_of(letters.begin(), letters.end(),
                                   [](char c) { return std::isprint(static_cast<unsigned char>(c)) != 0; });
  return is_text ? "'" + letters + "'" : std::to_string(pixelformat);
}

int32_t formatNamed(const std::string& name) {
  const auto& all = rawFormats();
  const auto found = std::find_if(all.begin(), all.end(), [&](const RawFormat& f) { return f.name == name; });
  return found == all.end() ? 0 : found->number;
}

}  // namespace redbee
