#include "redbee/image_codec/png.hpp"

#include <spng.h>
#include <zlib.h>

#include <cstdlib>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

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
  // Maps of one channel consist of runs, which a filter of differences, 16 million instructions a frame,
  // makes no shorter.
  const bool is_map = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE;
  spng_set_option(png.get(), SPNG_IMG_COMPRESSION_LEVEL, Z_BEST_SPEED);
  spng_set_option(png.get(), SPNG_IMG_COMPRESSION_STRATEGY, Z_RLE);
  spng_set_option(png.get(), SPNG_FILTER_CHOICE, is_map ? SPNG_FILTER_CHOICE_NONE : SPNG_FILTER_CHOICE_SUB);
  int fault = spng_set_ihdr(png.get(), &header);
  if (!fault) fault = spng_encode_image(png.get(), pixels, size, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  size_t length = 0;
  const std::unique_ptr<void, void (*)(void*)> buffer(
      fault ? nullptr : spng_get_png_buffer(png.get(), &length, &fault), std::free);
  if (fault) throw std::invalid_argument(std::string("encodePng: ") + spng_strerror(fault));
  const auto* first = static_cast<const uint8_t*>(buffer.get());
  return {first, first + length};
}

spng_ihdr pngHeader(const cv::Mat& image, spng_color_type colour, uint8_t bits) {
  spng_ihdr header{};
  header.width = static_cast<uint32_t>(image.cols);
  header.height = static_cast<uint32_t>(image.rows);
  header.bit_depth = bits;
  header.color_type = static_cast<uint8_t>(colour);
  return header;
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
  cv::Mat pixels;
  auto colour = SPNG_COLOR_TYPE_GRAYSCALE;
  if (image.type() == CV_8UC1) {
    pixels = image.isContinuous() ? image : image.clone();
  } else if (image.type() == CV_8UC3) {
    cv::cvtColor(image, pixels, cv::COLOR_BGR2RGB);
    colour = SPNG_COLOR_TYPE_TRUECOLOR;
  } else if (image.type() == CV_8UC4) {
    cv::cvtColor(image, pixels, cv::COLOR_BGRA2RGBA);
    colour = SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
  } else {
    throw std::invalid_argument("encodePng: an image that is neither grey nor BGR nor BGRA of 8 bits");
  }
  return encode(pngHeader(image, colour, 8), pixels.data, pixels.total() * pixels.elemSize());
}

std::vector<uint8_t> encodeBilevelPng(const cv::Mat1b& map) {
  const size_t row_bytes = (static_cast<size_t>(map.cols) + 7) / 8;
  std::vector<uint8_t> bits(row_bytes * static_cast<size_t>(map.rows));
  for (int v = 0; v < map.rows; ++v) {
    uint8_t* packed = bits.data() + static_cast<size_t>(v) * row_bytes;
    const uint8_t* row = map[v];
    for (int u = 0; u < map.cols; ++u) {
      if (row[u]) packed[u / 8] = static_cast<uint8_t>(packed[u / 8] | 0x80U >> static_cast<unsigned>(u % 8));
    }
  }
  return encode(pngHeader(map, SPNG_COLOR_TYPE_GRAYSCALE, 1), bits.data(), bits.size());
}

}  // namespace redbee
