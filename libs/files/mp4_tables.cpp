#include "redbee/files/mp4_tables.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include "redbee/files/input_error.hpp"

namespace redbee {
namespace {

constexpr int64_t kFewSamples = 10'000'000;  // an index of which takes some 200 MB

bool isContainer(std::string_view type) {
  static constexpr std::array<std::string_view, 12> kContainers{
      "moov", "trak", "mdia", "minf", "stbl", "moof", "traf", "mvex", "udta", "edts", "dinf", "gmhd"};
  return std::find(kContainers.begin(), kContainers.end(), type) != kContainers.end();
}

class Tables {
 public:
  explicit Tables(const std::filesystem::path& file)
      : file_(file),
        in_(file, std::ios::binary),
        size_(static_cast<int64_t>(std::filesystem::file_size(file))) {}

  void check() { checkBoxes(0, size_, 0); }

 private:
  /// Big-endian; 0 behind the end.
  int64_t numberAt(int64_t at, int bytes) {
    std::array<unsigned char, 8> read{};
    in_.clear();
    in_.seekg(at);
    in_.read(reinterpret_cast<char*>(read.data()), bytes);
    uint64_t number = 0;
    for (int i = 0; i < bytes; ++i) number = number << 8U | read[static_cast<size_t>(i)];
    return static_cast<int64_t>(number);
  }

  std::string typeAt(int64_t at) {
    std::string type(4, '\0');
    in_.clear();
    in_.seekg(at);
    in_.read(type.data(), 4);
    return type;
  }

  void checkBoxes(int64_t at, int64_t end, int depth) {
    constexpr int64_t kShort = 8, kLong = 16;
    constexpr int kDeepest = 10;
    constexpr int kMostBoxes = 100'000;  // of a recording: some hundreds, and two for each fragment
    while (end - at >= kShort && ++boxes_ <= kMostBoxes) {
      int64_t size = numberAt(at, 4);
      const std::string type = typeAt(at + 4);
      const int64_t header = size == 1 ? kLong : kShort;
      if (size == 1) size = numberAt(at + kShort, 8);
      if (size == 0 || size > end - at) size = end - at;  // as ffmpeg takes it
      if (size < header) return;
      const int64_t begin = at + header;
      at += size;
      if (isContainer(type)) {
        if (depth < kDeepest) checkBoxes(begin, at, depth + 1);
      } else {
        checkTable(type, begin, at);
      }
    }
  }

  void checkTable(const std::string& type, int64_t begin, int64_t end) {
    if (type == "stsz") {
      const bool is_list = numberAt(begin + 4, 4) == 0;
      count(numberAt(begin + 8, 4), is_list ? 8 * sizeof(uint32_t) : 0, end - begin - 12);
    } else if (type == "stz2") {
      count(numberAt(begin + 8, 4), static_cast<uint64_t>(numberAt(begin + 7, 1)), end - begin - 12);
    } else if (type == "trun") {
      uint64_t fields = 0;  // for each sample
      for (const int64_t flag : {0x100, 0x200, 0x400, 0x800})
        fields += (numberAt(begin, 4) & flag) != 0 ? 1 : 0;
      count(numberAt(begin + 4, 4), 8 * sizeof(uint32_t) * fields, end - begin - 8);
    }
  }

  /// `bits`: what the table has for each.
  void count(int64_t samples, uint64_t bits, int64_t table_bytes) {
    samples_ += samples;
    const bool fit = samples * static_cast<int64_t>(bits) <= 8 * std::max<int64_t>(0, table_bytes);
    if (samples_ <= kFewSamples || (samples_ <= size_ && fit)) return;
    throw InputError(file_, "is damaged: it states " + std::to_string(samples_) + " samples in " +
                                std::to_string(size_) + " bytes");
  }

  const std::filesystem::path& file_;
  std::ifstream in_;
  int boxes_ = 0;  ///< looked at
  int64_t size_;
  int64_t samples_ = 0;  ///< of all tracks
};

}  // namespace

void requirePossibleTables(const std::filesystem::path& file) { Tables(file).check(); }

}  // namespace redbee
