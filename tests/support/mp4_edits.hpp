// Gives the first track of an MP4 another edit list, as a program that cuts without encoding does.
#pragma once

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace redbee::test {

struct Mp4Edit {
  double duration_s = 0;
  double media_s = 0;  ///< its start on the track's own clock
};

struct Mp4Box {
  size_t at = 0;
  size_t size = 0;
};

inline uint32_t mp4Number(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<uint8_t>(bytes.at(i));
  return value;
}

inline std::string mp4Bytes(uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
  return bytes;
}

/// The first box of this kind in `inside`, whose own header is passed over; size 0 where there is none.
inline Mp4Box findBox(const std::string& bytes, Mp4Box inside, const std::string& kind, size_t header = 8) {
  for (size_t at = inside.at + header; at < inside.at + inside.size;) {
    const Mp4Box box{at, mp4Number(bytes, at)};
    if (bytes.compare(at + 4, 4, kind) == 0) return box;
    at += box.size;
  }
  return {};
}

inline std::string mp4Box(const std::string& kind, const std::string& content) {
  return mp4Bytes(static_cast<uint32_t>(8 + content.size())) + kind + content;
}

/// For a file whose index lies behind its frames, so that no frame moves.
inline void setEdits(const std::filesystem::path& file, const std::vector<Mp4Edit>& edits) {
  const std::string bytes = readText(file);
  const Mp4Box moov = findBox(bytes, {0, bytes.size()}, "moov", 0), trak = findBox(bytes, moov, "trak");
  const Mp4Box mdia = findBox(bytes, trak, "mdia"), old = findBox(bytes, trak, "edts");
  if (moov.at + moov.size != bytes.size()) throw std::runtime_error("the index is not at the end");
  constexpr size_t kTimescaleAt = 20;
  const double movie = mp4Number(bytes, findBox(bytes, moov, "mvhd").at + kTimescaleAt);
  const double media = mp4Number(bytes, findBox(bytes, mdia, "mdhd").at + kTimescaleAt);
  std::string list = mp4Bytes(0) + mp4Bytes(static_cast<uint32_t>(edits.size()));
  for (const Mp4Edit& edit : edits) {
    list += mp4Bytes(static_cast<uint32_t>(std::lround(edit.duration_s * movie)));
    list += mp4Bytes(static_cast<uint32_t>(std::lround(edit.media_s * media))) + mp4Bytes(0x10000);
  }
  std::string track = bytes.substr(trak.at + 8, trak.size - 8);
  track.insert(mdia.at - trak.at - 8, mp4Box("edts", mp4Box("elst", list)));
  if (old.size > 0) track.erase(old.at - trak.at - 8, old.size);  // it lies before the media
  const std::string before = bytes.substr(moov.at + 8, trak.at - moov.at - 8);
  const std::string after = bytes.substr(trak.at + trak.size);
  writeText(file, bytes.substr(0, moov.at) + mp4Box("moov", before + mp4Box("trak", track) + after));
}

}  // namespace redbee::test
