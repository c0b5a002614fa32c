#include "redbee/files/decompress.hpp"

#include <gtest/gtest.h>
#include <zstd.h>

namespace redbee::test {
namespace {

TEST(SizeOfZstdFrame, IsWhatItStatesAndItsBytesCanGive) {
  constexpr size_t kSize = 10'000'000, kMost = 1 << 30;
  const std::vector<uint8_t> zeros(kSize);  // as small as a frame can be
  std::vector<uint8_t> packed(ZSTD_compressBound(kSize));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), zeros.data(), kSize, 19));
  EXPECT_EQ(sizeOfZstdFrame({packed.data(), packed.size()}, kMost), kSize);
  EXPECT_EQ(decompress("zstd", {packed.data(), packed.size()}, kSize).bytes, zeros);
  EXPECT_FALSE(sizeOfZstdFrame({packed.data(), packed.size()}, kSize - 1));
  EXPECT_FALSE(sizeOfZstdFrame({packed.data(), 12}, kMost)) << "nothing is allocated for what cannot come";
  EXPECT_FALSE(sizeOfZstdFrame({zeros.data(), 100}, kMost));
  EXPECT_FALSE(sizeOfZstdFrame({zeros.data(), 0}, kMost));
}

}  // namespace
}  // namespace redbee::test
