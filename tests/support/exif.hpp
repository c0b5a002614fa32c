// JPEGs with EXIF data that states the lens.
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "redbee/image_codec/jpeg.hpp"

namespace redbee::test {

/// Big endian; the entries of the EXIF directory in order of their tags, as the standard wants it.
class ExifWriter {
 public:
  std::vector<uint8_t> bytes{'M', 'M', 0, 42};
  void number(uint32_t value, int size) {
    for (int i = size - 1; i >= 0; --i) bytes.push_back(static_cast<uint8_t>(value >> (8 * i)));
  }
  void entry(uint32_t tag, uint32_t type, uint32_t value) {
    number(tag, 2);
    number(type, 2);
    number(1, 4);
    if (type == kShort) {
      number(value, 2);
      number(0, 2);
    } else {
      number(value, 4);
    }
  }
  static constexpr uint32_t kShort = 3, kLong = 4, kRational = 5;
};

/// All of `lens` must be stated.
inline std::string withExifLens(const cv::Mat& image, const ExifLens& lens) {
  ExifWriter exif;
  exif.number(8, 4);  // of the first directory
  exif.number(1, 2);
  exif.entry(0x8769, ExifWriter::kLong, 26);  // of the EXIF directory
  exif.number(0, 4);
  constexpr uint32_t kValues = 26 + 2 + 3 * 12 + 4;
  exif.number(3, 2);
  exif.entry(0x920A, ExifWriter::kRational, kValues);
  exif.entry(0xA404, ExifWriter::kRational, kValues + 8);
  exif.entry(0xA405, ExifWriter::kShort, static_cast<uint32_t>(std::lround(*lens.equivalent_mm)));
  exif.number(0, 4);
  for (const double value : {*lens.focal_mm, lens.digital_zoom}) {
    exif.number(static_cast<uint32_t>(std::lround(1000 * value)), 4);
    exif.number(1000, 4);
  }
  std::vector<uint8_t> jpeg;
  cv::imencode(".jpg", image, jpeg);
  const std::string name("Exif\0\0", 6);
  const size_t length = 2 + name.size() + exif.bytes.size();
  std::vector<uint8_t> segment{0xFF, 0xE1, static_cast<uint8_t>(length >> 8), static_cast<uint8_t>(length)};
  segment.insert(segment.end(), name.begin(), name.end());
  segment.insert(segment.end(), exif.bytes.begin(), exif.bytes.end());
  jpeg.insert(jpeg.begin() + 2, segment.begin(), segment.end());
  return {jpeg.begin(), jpeg.end()};
}

}  // namespace redbee::test
