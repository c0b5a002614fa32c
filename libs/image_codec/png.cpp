#include "redbee/image_codec/png.hpp"

#include <spng.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "redbee/image_codec/run_deflate.hpp"

namespace redbee {
namespace {

constexpr uint32_t kMaxPngSide = 16384;
constexpr size_t kMaxChunk = 64U << 20U;

using Png = std::unique_ptr<spng_ctx, void (*)(spng_ctx*)>;

/// What a stored image is decoded to. libspng gives colours of 16 bits with transparency alone.
struct Layout {
  spng_format format;
  int type;
};

Layout layoutOf(const spng_ihdr& header) {
  const bool deep = header.bit_depth == 16;
  if (header.color_type == SPNG_COLOR_TYPE_GRAYSCALE)
    return deep ? Layout{SPNG_FMT_PNG, CV_16UC1} : Layout{SPNG_FMT_G8, CV_8UC1};
  return deep ? Layout{SPNG_FMT_RGBA16, CV_16UC4} : Layout{SPNG_FMT_RGB8, CV_8UC3};
}

/// `pixels`: rows of `header`'s bits, one directly after the other.
std::vector<uint8_t> encode(spng_ihdr header, const uint8_t* pixels, size_t size) {
  const Png png(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
  spng_set_option(png.get(), SPNG_ENCODE_TO_BUFFER, 1);
  spng_set_option(png.get(), SPNG_IMG_COMPRESSION_LEVEL, Z_BEST_SPEED);
  spng_set_option(png.get(), SPNG_IMG_COMPRESSION_STRATEGY, Z_RLE);
  spng_set_option(png.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_SUB);
  int fault = spng_set_ihdr(png.get(), &header);
  if (!fault) fault = spng_encode_image(png.get(), pixels, size, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  size_t length = 0;
  const std::unique_ptr<void, void (*)(void*)> buffer(
      fault ? nullptr : spng_get_png_buffer(png.get(), &length, &fault), std::free);
  if (fault) throw std::invalid_argument(std::string("encodePng: ") + spng_strerror(fault));
  const auto* first = static_cast<const uint8_t*>(buffer.get());
  return {first, first + length};
}

spng_ihdr pngHeader(const cv::Mat& image, spng_color_type colour) {
  spng_ihdr header{};
  header.width = static_cast<uint32_t>(image.cols);
  header.height = static_cast<uint32_t>(image.rows);
  header.bit_depth = 8;
  header.color_type = static_cast<uint8_t>(colour);
  return header;
}

void putNumber(std::vector<uint8_t>& to, uint32_t number) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) to.push_back(static_cast<uint8_t>(number >> shift));
}

void putChunk(std::vector<uint8_t>& to, const char* name, const std::vector<uint8_t>& content) {
  putNumber(to, static_cast<uint32_t>(content.size()));
  const size_t checked = to.size();
  to.insert(to.end(), name, name + 4);
  to.insert(to.end(), content.begin(), content.end());
  putNumber(to, static_cast<uint32_t>(crc32(0, to.data() + checked, static_cast<uInt>(to.size() - checked))));
}

/// Maps of one channel consist of runs, which a filter of differences makes no shorter. `rows`: behind a byte
/// for the filter each, which is 0.
std::vector<uint8_t> encodeMap(cv::Size size, uint8_t bits, const std::vector<uint8_t>& rows) {
  if (size.empty()) throw std::invalid_argument("encodePng: an empty image");
  std::vector<uint8_t> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  std::vector<uint8_t> header;
  putNumber(header, static_cast<uint32_t>(size.width));
  putNumber(header, static_cast<uint32_t>(size.height));
  for (const int value : {int{bits}, int{SPNG_COLOR_TYPE_GRAYSCALE}, 0, 0, 0})
    header.push_back(static_cast<uint8_t>(value));
  putChunk(png, "IHDR", header);
  putChunk(png, "IDAT", deflateRuns(rows.data(), rows.size()));
  putChunk(png, "IEND", {});
  return png;
}

/// Eight pixels, the first one the highest bit.
uint8_t packed(const uint8_t* pixels, int count) {
  unsigned bits = 0;
  for (int i = 0; i < count; ++i) bits |= pixels[i] != 0 ? 0x80U >> static_cast<unsigned>(i) : 0U;
  return static_cast<uint8_t>(bits);
}

}  // namespace

cv::Mat decodePng(const std::vector<uint8_t>& bytes) {
  const Png png(spng_ctx_new(0), spng_ctx_free);
  spng_set_image_limits(png.get(), kMaxPngSide, kMaxPngSide);
  spng_set_chunk_limits(png.get(), kMaxChunk, kMaxChunk);
  spng_ihdr header{};
  if (spng_set_png_buffer(png.get(), bytes.data(), bytes.size()) || spng_get_ihdr(png.get(), &header))
    return {};
  const Layout layout = layoutOf(header);
  size_t size = 0;
  if (spng_decoded_image_size(png.get(), layout.format, &size)) return {};
  cv::Mat image(static_cast<int>(header.height), static_cast<int>(header.width), layout.type);
  if (size != image.total() * image.elemSize() ||
      spng_decode_image(png.get(), image.data, size, layout.format, 0))
    return {};
  if (image.channels() == 3) cv::cvtColor(image, image, cv::COLOR_RGB2BGR);
  if (image.channels() == 4) cv::cvtColor(image, image, cv::COLOR_RGBA2BGR);
  return image;
}

std::vector<uint8_t> encodePng(const cv::Mat& image) {
  if (image.type() == CV_8UC1) {
    const auto width = static_cast<size_t>(image.cols);
    std::vector<uint8_t> rows((width + 1) * static_cast<size_t>(image.rows));
    for (int v = 0; v < image.rows; ++v)
      std::copy_n(image.ptr(v), width, rows.data() + static_cast<size_t>(v) * (width + 1) + 1);
    return encodeMap(image.size(), 8, rows);
  }
  cv::Mat pixels;
  if (image.type() == CV_8UC3) {
    cv::cvtColor(image, pixels, cv::COLOR_BGR2RGB);
    return encode(pngHeader(image, SPNG_COLOR_TYPE_TRUECOLOR), pixels.data,
                  pixels.total() * pixels.elemSize());
  }
  if (image.type() == CV_8UC4) {
    cv::cvtColor(image, pixels, cv::COLOR_BGRA2RGBA);
    return encode(pngHeader(image, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA), pixels.data,
                  pixels.total() * pixels.elemSize());
  }
  throw std::invalid_argument("encodePng: an image that is neither grey nor BGR nor BGRA of 8 bits");
}

std::vector<uint8_t> encodeBilevelPng(const cv::Mat1b& map) {
  constexpr int kBits = 8;
  const auto row_bytes = static_cast<size_t>((map.cols + kBits - 1) / kBits);
  std::vector<uint8_t> rows((row_bytes + 1) * static_cast<size_t>(map.rows));
  for (int v = 0; v < map.rows; ++v) {
    uint8_t* to = rows.data() + static_cast<size_t>(v) * (row_bytes + 1) + 1;
    for (int u = 0; u < map.cols; u += kBits, ++to) {
      uint64_t eight = 0;
      const int count = std::min(kBits, map.cols - u);
      std::memcpy(&eight, map[v] + u, static_cast<size_t>(count));
      if (eight != 0) *to = eight == ~uint64_t{0} ? 0xFF : packed(map[v] + u, count);
    }
  }
  return encodeMap(map.size(), 1, rows);
}

}  // namespace redbee
