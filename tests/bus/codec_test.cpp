#include "redbee/bus/codec.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>
#include <random>

#include "tests/bus/sample_messages.hpp"

namespace {

std::atomic<size_t> largest_allocation{0};

void note(size_t size) {
  size_t largest = largest_allocation;
  while (size > largest && !largest_allocation.compare_exchange_weak(largest, size)) {
  }
}

}  // namespace

// Counts every allocation of this program, so that a test can measure the cost of a wrong length. Inlined,
// they would make GCC take malloc and delete for a mismatch.
[[gnu::noinline]] void* operator new(size_t size) {
  note(size);
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, size_t) noexcept { std::free(memory); }

namespace redbee::test {
namespace {

/// A decoder may allocate a small multiple of the bytes it was given.
size_t allowedAllocation(size_t bytes) { return 16 * bytes + 256; }

template <typename Message>
class CodecTest : public testing::Test {
 protected:
  static bool decodes(const std::vector<uint8_t>& data) {
    Message message;
    return decodeMessage(data.data(), static_cast<int>(data.size()), message);
  }
  /// Decodes untrusted bytes; the test fails if decoding throws or allocates too much.
  static bool decodesCheaply(const std::vector<uint8_t>& data) {
    bool decoded = false;
    largest_allocation = 0;
    EXPECT_NO_THROW(decoded = decodes(data));
    EXPECT_LE(largest_allocation, allowedAllocation(data.size()));
    return decoded;
  }
};

template <typename List>
struct GoogleTestTypes;
template <typename... Messages>
struct GoogleTestTypes<TypeList<Messages...>> {
  using Types = ::testing::Types<Messages...>;
};
using AllTypes = GoogleTestTypes<MessageTypes>::Types;

struct MessageName {
  template <typename Message>
  static std::string GetName(int) {
    return Message::getTypeName();
  }
};
TYPED_TEST_SUITE(CodecTest, AllTypes, MessageName);

void overwrite(std::vector<uint8_t>& data, size_t at, int32_t value) {
  for (size_t i = 0; i < 4; ++i)
    data[at + i] = static_cast<uint8_t>(static_cast<uint32_t>(value) >> (24 - 8 * i));
}

TYPED_TEST(CodecTest, WhatIsEncodedDecodesToTheSame) {
  const auto data = encodeMessage(sample<TypeParam>());
  TypeParam decoded;
  ASSERT_TRUE(decodeMessage(data.data(), static_cast<int>(data.size()), decoded));
  EXPECT_EQ(encodeMessage(decoded), data);
  EXPECT_NE(encodeMessage(TypeParam{}), data) << "the sample is empty";
}

TYPED_TEST(CodecTest, AnEmptyMessageDecodes) { EXPECT_TRUE(this->decodes(encodeMessage(TypeParam{}))); }

TYPED_TEST(CodecTest, RefusesEveryTruncation) {
  const auto data = encodeMessage(sample<TypeParam>());
  for (size_t size = 0; size < data.size(); ++size) {
    // A copy of just this size, so that a sanitizer sees a read beyond it.
    EXPECT_FALSE(
        this->decodesCheaply(std::vector<uint8_t>(data.begin(), data.begin() + static_cast<long>(size))))
        << "cut to " << size << " of " << data.size();
  }
}

TYPED_TEST(CodecTest, RefusesASurplusByte) {
  auto data = encodeMessage(sample<TypeParam>());
  data.push_back(0);
  EXPECT_FALSE(this->decodesCheaply(data));
}

TYPED_TEST(CodecTest, RefusesAnotherHash) {
  for (size_t i = 0; i < 8; ++i) {
    auto data = encodeMessage(sample<TypeParam>());
    data[i] ^= 1;
    EXPECT_FALSE(this->decodesCheaply(data));
  }
}

// For each length field: bytes that decode must encode to the same bytes, all others are refused, and neither
// allocates much.
TYPED_TEST(CodecTest, AFalseLengthAnywhereAllocatesNothing) {
  const auto data = encodeMessage(sample<TypeParam>());
  const int32_t lies[] = {-1,
                          std::numeric_limits<int32_t>::min(),
                          std::numeric_limits<int32_t>::max(),
                          0x10000000,
                          1 << 20,
                          255,
                          1,
                          0};
  for (size_t at = 8; at + 4 <= data.size(); ++at) {
    for (const int32_t lie : lies) {
      auto damaged = data;
      overwrite(damaged, at, lie);
      if (!this->decodesCheaply(damaged)) continue;
      TypeParam decoded;
      ASSERT_TRUE(decodeMessage(damaged.data(), static_cast<int>(damaged.size()), decoded));
      EXPECT_EQ(encodeMessage(decoded).size(), damaged.size());
    }
  }
}

TYPED_TEST(CodecTest, RandomBytesBehindTheHashAllocateNothing) {
  std::mt19937 random(7);
  const auto data = encodeMessage(sample<TypeParam>());
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<uint8_t> noise(data.begin(), data.begin() + 8);
    noise.resize(8 + random() % 400);
    for (size_t i = 8; i < noise.size(); ++i) noise[i] = static_cast<uint8_t>(random());
    this->decodesCheaply(noise);
  }
}

TYPED_TEST(CodecTest, EveryCorruptedLengthIsRefused) {
  const auto message = sample<TypeParam>();
  const auto data = encodeMessage(message);
  for (const size_t at : lengthOffsets(message)) {
    for (const int32_t change : {-1, 1, -1000, 1000000, 2000000000}) {
      auto damaged = data;
      const auto old = static_cast<int32_t>(static_cast<uint32_t>(data[at]) << 24 |
                                            static_cast<uint32_t>(data[at + 1]) << 16 |
                                            static_cast<uint32_t>(data[at + 2]) << 8 | data[at + 3]);
      overwrite(damaged, at, old + change);
      EXPECT_FALSE(this->decodesCheaply(damaged)) << "length at " << at << " changed by " << change;
    }
  }
}

TEST(Codec, LengthsOfAnImageAreWhereTheWireHasThem) {
  image_t image{};
  image.data = {1, 2, 3};
  image.size = 3;
  image.metadata.resize(1);
  image.metadata[0].key = "ab";
  image.nmetadata = 1;
  EXPECT_EQ(lengthOffsets(image), (std::vector<size_t>{8 + 24, 8 + 28 + 3, 8 + 35, 8 + 35 + 4 + 3}));
}

TEST(Codec, DoesNotEncodeACountThatDisagreesWithItsArray) {
  auto image = sample<image_t>();
  image.size += 1;
  EXPECT_THROW(encodeMessage(image), std::invalid_argument);
  image = sample<image_t>();
  image.metadata[1].n = 1000;
  EXPECT_THROW(encodeMessage(image), std::invalid_argument);
  auto visual = sample<visual_homography_t>();
  visual.tracks.inlier.pop_back();
  EXPECT_THROW(encodeMessage(visual), std::invalid_argument);
}

TEST(Codec, DoesNotEncodeAStringWithANul) {
  auto health = sample<process_health_t>();
  health.message = std::string("a\0b", 3);
  EXPECT_THROW(encodeMessage(health), std::invalid_argument);
}

TEST(Codec, HashesOfTypesSharedWithOtherVehiclesStayFixed) {
  EXPECT_EQ(static_cast<uint64_t>(image_t::getHash()), 0x14739ffe13d5f5f0U);
  EXPECT_EQ(static_cast<uint64_t>(ins_t::getHash()), 0x88a7df61422b0840U);
  EXPECT_EQ(static_cast<uint64_t>(altimeter_t::getHash()), 0x9b4d867993ac0184U);
}

}  // namespace
}  // namespace redbee::test
