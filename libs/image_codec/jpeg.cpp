#include "redbee/image_codec/jpeg.hpp"

#include <libexif/exif-data.h>
#include <turbojpeg.h>

#include <algorithm>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace redbee {
namespace {

constexpr int kMaxJpegSide = 16384;

struct CloseTurbo {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Turbo = std::unique_ptr<void, CloseTurbo>;
struct FreeTurbo {
  void operator()(unsigned char* memory) const { tjFree(memory); }
};

/// One for all images of a thread: making it costs as much as a small image.
void* decompressor() {
  thread_local const Turbo handle(tjInitDecompress());
  return handle.get();
}

void* compressor() {
  thread_local const Turbo handle(tjInitCompress());
  return handle.get();
}

struct Header {
  cv::Size size;
  int colour_space = -1;
};

/// Of no size if there is none.
Header headerOf(const std::vector<uint8_t>& bytes) {
  Header header;
  int subsampling = 0;
  if (tjDecompressHeader3(decompressor(), bytes.data(), static_cast<unsigned long>(bytes.size()),
                          &header.size.width, &header.size.height, &subsampling, &header.colour_space) != 0)
    return {};
  return header;
}

}  // namespace

bool isGreyJpeg(const std::vector<uint8_t>& bytes) { return headerOf(bytes).colour_space == TJCS_GRAY; }

cv::Mat decodeJpeg(const std::vector<uint8_t>& bytes, bool colour, int downscale) {
  const Header header = headerOf(bytes);
  const cv::Size size = header.size;
  if (size.empty() || size.width > kMaxJpegSide || size.height > kMaxJpegSide) return {};
  if (colour && header.colour_space == TJCS_GRAY) {
    // TurboJPEG would copy pixel by pixel.
    cv::Mat image = decodeJpeg(bytes, false, downscale);
    if (!image.empty()) cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
    return image;
  }
  void* turbo = decompressor();
  const auto length = static_cast<unsigned long>(bytes.size());
  const tjscalingfactor factor{1, downscale};
  cv::Mat image(TJSCALED(size.height, factor), TJSCALED(size.width, factor), colour ? CV_8UC3 : CV_8UC1);
  const int flags = TJFLAG_LIMITSCANS;  // many empty scans make a small file slow
  const int status =
      tjDecompress2(turbo, bytes.data(), length, image.data, image.cols, static_cast<int>(image.step),
                    image.rows, colour ? TJPF_BGR : TJPF_GRAY, flags);
  if (status != 0 && tjGetErrorCode(turbo) != TJERR_WARNING) return {};
  return image;
}

namespace {

using Exif = std::unique_ptr<ExifData, void (*)(ExifData*)>;

Exif exifOf(const std::vector<uint8_t>& bytes) {
  return {exif_data_new_from_data(bytes.data(), static_cast<unsigned>(bytes.size())), exif_data_unref};
}

/// A number above 0.
std::optional<double> exifNumber(const Exif& exif, ExifTag tag) {
  const ExifEntry* entry = exif_content_get_entry(exif->ifd[EXIF_IFD_EXIF], tag);
  const ExifByteOrder order = exif_data_get_byte_order(exif.get());
  if (!entry) return std::nullopt;
  double value = 0;
  if (entry->format == EXIF_FORMAT_SHORT && entry->size >= 2) {
    value = exif_get_short(entry->data, order);
  } else if (entry->format == EXIF_FORMAT_RATIONAL && entry->size >= 8) {
    const ExifRational fraction = exif_get_rational(entry->data, order);
    value = fraction.denominator == 0 ? 0 : static_cast<double>(fraction.numerator) / fraction.denominator;
  }
  return value > 0 ? std::optional(value) : std::nullopt;
}

}  // namespace

ExifLens jpegLens(const std::vector<uint8_t>& bytes) {
  const Exif exif = exifOf(bytes);
  if (!exif) return {};
  return {exifNumber(exif, EXIF_TAG_FOCAL_LENGTH), exifNumber(exif, EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM),
          exifNumber(exif, EXIF_TAG_DIGITAL_ZOOM_RATIO).value_or(1)};
}

int jpegOrientation(const std::vector<uint8_t>& bytes) {
  const Exif exif = exifOf(bytes);
  if (!exif) return 1;
  const ExifEntry* entry = exif_content_get_entry(exif->ifd[EXIF_IFD_0], EXIF_TAG_ORIENTATION);
  if (!entry || entry->format != EXIF_FORMAT_SHORT || entry->size < 2) return 1;
  const int orientation = exif_get_short(entry->data, exif_data_get_byte_order(exif.get()));
  return orientation >= 1 && orientation <= 8 ? orientation : 1;
}

cv::Mat upright(const cv::Mat& image, int orientation) {
  constexpr int kVertically = 0;
  constexpr int kHorizontally = 1;
  constexpr int kBoth = -1;
  cv::Mat turned;
  if (orientation >= 5) {
    cv::transpose(image, turned);
  } else {
    turned = image.clone();
  }
  switch (orientation) {
    case 2:
    case 6:
      cv::flip(turned, turned, kHorizontally);
      break;
    case 3:
    case 7:
      cv::flip(turned, turned, kBoth);
      break;
    case 4:
    case 8:
      cv::flip(turned, turned, kVertically);
      break;
    default:
      break;
  }
  return turned;
}

std::vector<uint8_t> encodeJpeg(const cv::Mat& image, int quality) {
  if (image.empty() || (image.type() != CV_8UC1 && image.type() != CV_8UC3))
    throw std::invalid_argument("encodeJpeg: an image that is neither grey nor BGR of 8 bits");
  const bool grey = image.channels() == 1;
  const int subsampling = grey ? TJSAMP_GRAY : TJSAMP_420;
  // Its memory grows with what is written: room for the worst case would be as large as the image.
  unsigned char* data = nullptr;
  unsigned long size = 0;
  const bool failed = tjCompress2(compressor(), image.data, image.cols, static_cast<int>(image.step),
                                  image.rows, grey ? TJPF_GRAY : TJPF_BGR, &data, &size, subsampling,
                                  std::clamp(quality, 1, 100), TJFLAG_ACCURATEDCT) != 0;
  const std::unique_ptr<unsigned char, FreeTurbo> owned(data);
  if (failed) throw std::invalid_argument(std::string("encodeJpeg: ") + tjGetErrorStr2(compressor()));
  return {data, data + size};
}

}  // namespace redbee
