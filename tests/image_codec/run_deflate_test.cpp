#include "redbee/image_codec/run_deflate.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace redbee {
namespace {

using Bytes = std::vector<uint8_t>;

/// As zlib reads it.
Bytes inflated(const Bytes& stream, size_t size) {
  Bytes bytes(size + 1);
  auto length = static_cast<uLongf>(bytes.size());
  EXPECT_EQ(uncompress(bytes.data(), &length, stream.data(), stream.size()), Z_OK);
  bytes.resize(length);
  return bytes;
}

void expectItself(const Bytes& bytes) {
  EXPECT_TRUE(inflated(deflateRuns(bytes.data(), bytes.size()), bytes.size()) == bytes) << bytes.size();
}

TEST(RunDeflate, RunsOfEveryLength) {
  for (const size_t behind : {0, 1, 2, 3, 7, 300}) {
    for (size_t run = 1; run < 1100; run += run < 600 ? 1 : 37) {
      Bytes bytes(run, uint8_t{200});
      bytes.insert(bytes.end(), behind, uint8_t{3});
      expectItself(bytes);
    }
  }
  expectItself(Bytes(3'000'000, uint8_t{255}));  // the sum of the check overflows 32 bits
}

TEST(RunDeflate, AnyBytes) {
  std::mt19937 random(1);
  for (const int values : {2, 3, 17, 256}) {
    Bytes bytes(70'000);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random() % static_cast<unsigned>(values));
    expectItself(bytes);
  }
}

/// So rare that their codes would be longer than the format allows.
TEST(RunDeflate, BytesOfVeryUnequalFrequency) {
  Bytes bytes;
  double count = 1;
  for (int value = 0; value < 26; ++value, count *= 1.62) {
    for (int i = 0; i < static_cast<int>(count); ++i) bytes.push_back(static_cast<uint8_t>(value));
  }
  std::shuffle(bytes.begin(), bytes.end(), std::mt19937(2));
  expectItself(bytes);
}

/// What zlib finds by Z_RLE.
size_t zlibs(const Bytes& bytes) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, MAX_WBITS, 8, Z_RLE);
  Bytes to(deflateBound(&stream, bytes.size()));
  stream.next_in = const_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = to.data();
  stream.avail_out = static_cast<uInt>(to.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  deflateEnd(&stream);
  return stream.total_out;
}

TEST(RunDeflate, AMapIsNotLargerThanZlibsByMoreThanAFiftieth) {
  Bytes map;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const double away = std::hypot(x - 300, y - 200) / 40;
      const double level = 255 * std::exp(-away * away);
      map.push_back(level < 6 ? uint8_t{0} : static_cast<uint8_t>(level));
    }
  }
  expectItself(map);
  EXPECT_LE(static_cast<double>(deflateRuns(map.data(), map.size()).size()),
            1.02 * static_cast<double>(zlibs(map)));
}

}  // namespace
}  // namespace redbee
