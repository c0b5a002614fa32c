#include "redbee/importers/image_file.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "redbee/bus/image.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

std::vector<uint8_t> readWhole(const std::filesystem::path& file) {
  requireFile(file);
  std::ifstream in(file, std::ios::binary);
  std::vector<uint8_t> bytes(static_cast<size_t>(std::filesystem::file_size(file)));
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw InputError(file, "cannot be read");
  if (bytes.empty()) throw InputError(file, "is an empty file");
  return bytes;
}

bool startsWith(const std::vector<uint8_t>& bytes, std::initializer_list<uint8_t> magic) {
  return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

/// A JPEG ends with FF D9; some cameras pad with zeros behind it.
bool hasEndOfImage(const std::vector<uint8_t>& bytes) {
  const auto last = std::find_if(bytes.rbegin(), bytes.rend(), [](uint8_t byte) { return byte != 0; });
  return std::distance(last, bytes.rend()) >= 2 && *last == 0xD9 && *std::next(last) == 0xFF;
}

image_t untouchedJpeg(const std::filesystem::path& file, int64_t utime, std::vector<uint8_t> bytes) {
  const auto size = jpegSize(bytes.data(), bytes.size());
  if (!size || size->empty()) throw InputError(file, "JPEG header is damaged or cut short");
  if (!hasEndOfImage(bytes)) throw InputError(file, "JPEG is cut short: no end-of-image marker");
  image_t message{};
  message.utime = utime;
  message.width = size->width;
  message.height = size->height;
  message.pixelformat = image_t::MJPEG;
  message.size = static_cast<int32_t>(bytes.size());
  message.data = std::move(bytes);
  return message;
}

}  // namespace

image_t loadImage(const std::filesystem::path& file, int64_t utime, const ImageOptions& options) {
  std::vector<uint8_t> bytes = readWhole(file);
  if (startsWith(bytes, {0xFF, 0xD8})) return untouchedJpeg(file, utime, std::move(bytes));
  if (!startsWith(bytes, {0x89, 'P', 'N', 'G'})) throw InputError(file, "is neither JPEG nor PNG");
  // The decoder silently fills the rest of a truncated file with grey; the end chunk shows that it is
  // complete.
  const std::string end_chunk = "IEND";
  const auto tail = bytes.end() - static_cast<long>(std::min<size_t>(bytes.size(), 12));
  if (std::search(tail, bytes.end(), end_chunk.begin(), end_chunk.end()) == bytes.end()) {
    throw InputError(file, "PNG is cut short: no end chunk");
  }
  const cv::Mat image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  if (image.empty()) throw InputError(file, "PNG cannot be decoded");
  if (image.type() != CV_8UC1 && image.type() != CV_8UC3) {
    throw InputError(file, "PNG is neither 8-bit grey nor 8-bit colour");
  }
  if (image.channels() == 1 && options.lossless_grey) return rawGreyMessage(utime, image);
  return jpegMessage(utime, image, options.jpeg_quality);
}

void ResolutionCheck::check(const std::filesystem::path& file, const image_t& image) {
  if (width_ == 0) {
    width_ = image.width;
    height_ = image.height;
  }
  if (image.width != width_ || image.height != height_) {
    throw InputError(file, "is " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                               " px, the images before it " + std::to_string(width_) + "x" +
                               std::to_string(height_));
  }
}

}  // namespace redbee
