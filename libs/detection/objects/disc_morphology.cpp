#include "redbee/detection/objects/disc_morphology.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "redbee/detection/objects/regions.hpp"

namespace redbee {
namespace {

constexpr int kWord = 64, kByte = 8;

/// A byte for each bit of the place, the lowest bit first.
constexpr std::array<uint64_t, 256> kBytesOfBits = [] {
  std::array<uint64_t, 256> bytes{};
  for (size_t bits = 0; bits < bytes.size(); ++bits) {
    for (size_t i = 0; i < kByte; ++i) {
      if ((bits >> i & 1) != 0) bytes[bits] |= uint64_t{255} << (kByte * i);
    }
  }
  return bytes;
}();

/// Bit by bit, of up to 64 pixels.
uint64_t packed(const uint8_t* pixels, int count) {
  uint64_t word = 0;
  if (count < kWord) {
    for (int i = 0; i < count; ++i) word |= uint64_t{pixels[i] != 0} << i;
    return word;
  }
  constexpr uint64_t kLowest = 0x0101010101010101, kGather = 0x0102040810204080;
  std::array<uint64_t, kByte> eights{};
  std::memcpy(eights.data(), pixels, kWord);
  uint64_t any = 0;
  for (const uint64_t eight : eights) any |= eight;
  if (any == 0) return 0;
  for (size_t i = 0; i < eights.size(); ++i)
    word |= ((eights[i] & kLowest) * kGather >> (kWord - kByte)) << (kByte * i);
  return word;
}

void unpack(uint64_t word, uint8_t* pixels, int count) {
  std::array<uint64_t, kByte> eights{};
  if (word != 0) {
    for (size_t i = 0; i < eights.size(); ++i) eights[i] = kBytesOfBits[word >> (kByte * i) & 255];
  }
  std::memcpy(pixels, eights.data(), static_cast<size_t>(std::min(count, kWord)));
}

/// A mask, a bit a pixel, the lowest of a word first. What is beyond the width is 0.
class BitMask {
 public:
  explicit BitMask(const cv::Mat1b& mask)
      : size_(mask.size()), words_((mask.cols + kWord - 1) / kWord), bits_(words() * rows()) {
    for (int y = 0; y < size_.height; ++y) {
      for (int i = 0; i < words_; ++i) row(y)[i] = packed(mask[y] + kWord * i, size_.width - kWord * i);
    }
  }

  void copyTo(cv::Mat1b& mask) const {
    for (int y = 0; y < size_.height; ++y) {
      const uint64_t* const from = bits_.data() + words() * static_cast<size_t>(y);
      for (int i = 0; i < words_; ++i) unpack(from[i], mask[y] + kWord * i, size_.width - kWord * i);
    }
  }

  /// `halves`: of a symmetric element's rows, the middle one first: half its width.
  void dilate(const std::vector<int>& halves) {
    std::vector<uint64_t> to(bits_.size());
    std::vector<uint64_t> wide(words());
    const auto reach = static_cast<int>(halves.size()) - 1;
    for (int y = 0; y < size_.height; ++y) {
      std::copy_n(row(y), words(), wide.begin());
      if (std::all_of(wide.begin(), wide.end(), [](uint64_t word) { return word == 0; })) continue;
      int half = 0;
      for (int away = reach; away >= 0; --away) {  // from the narrowest row of the element on
        for (; half < halves[static_cast<size_t>(away)]; ++half) widen(wide);
        for (const int target : {y - away, y + away}) {
          if (target < 0 || target >= size_.height) continue;
          uint64_t* const out = to.data() + words() * static_cast<size_t>(target);
          for (size_t i = 0; i < words(); ++i) out[i] |= wide[i];
        }
      }
    }
    bits_ = std::move(to);
    clearBeyond();
  }
  void erode(const std::vector<int>& halves) {
    invert();
    dilate(halves);
    invert();
  }

 private:
  size_t words() const { return static_cast<size_t>(words_); }
  size_t rows() const { return static_cast<size_t>(size_.height); }
  uint64_t* row(int y) { return bits_.data() + words() * static_cast<size_t>(y); }

  /// By a pixel to either side.
  static void widen(std::vector<uint64_t>& row) {
    uint64_t before = 0;
    for (size_t i = 0; i < row.size(); ++i) {
      const uint64_t own = row[i], after = i + 1 < row.size() ? row[i + 1] : 0;
      row[i] = own | own << 1 | before >> (kWord - 1) | own >> 1 | after << (kWord - 1);
      before = own;
    }
  }
  void invert() {
    for (uint64_t& word : bits_) word = ~word;
    clearBeyond();
  }
  void clearBeyond() {
    const int inside = size_.width % kWord;
    if (inside == 0) return;
    for (int y = 0; y < size_.height; ++y) row(y)[words_ - 1] &= (uint64_t{1} << inside) - 1;
  }

  cv::Size size_;
  int words_;  ///< a row
  std::vector<uint64_t> bits_;
};

/// Half the width of each row, from the middle one on.
std::vector<int> halvesOf(const cv::Mat1b& disc) {
  std::vector<int> halves;
  for (int y = disc.rows / 2; y < disc.rows; ++y) halves.push_back(cv::countNonZero(disc.row(y)) / 2);
  return halves;
}

bool isSymmetric(int diameter) { return diameter <= 0 || diameter % 2 == 1; }

}  // namespace

void openAndClose(cv::Mat1b& mask, int opening_px, int closing_px) {
  if (mask.empty() || (opening_px <= 0 && closing_px <= 0)) return;
  if (!isSymmetric(opening_px) || !isSymmetric(closing_px)) {
    if (opening_px > 0) cv::morphologyEx(mask, mask, cv::MORPH_OPEN, disc(opening_px));
    if (closing_px > 0) cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, disc(closing_px));
    return;
  }
  BitMask bits(mask);
  if (opening_px > 0) {
    const std::vector<int> halves = halvesOf(disc(opening_px));
    bits.erode(halves);
    bits.dilate(halves);
  }
  if (closing_px > 0) {
    const std::vector<int> halves = halvesOf(disc(closing_px));
    bits.dilate(halves);
    bits.erode(halves);
  }
  bits.copyTo(mask);
}

}  // namespace redbee
