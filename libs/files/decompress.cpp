#include "redbee/files/decompress.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <new>

namespace redbee {
namespace {

constexpr const char* kOtherSize = "gives another size than stated";

/// Block by block, which is slower than at once.
size_t decompressZstdBlocks(ByteView compressed, std::vector<uint8_t>& plain) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_inBuffer from{compressed.data, compressed.size, 0};
  ZSTD_outBuffer to{plain.data(), plain.size(), 0};
  while (from.pos < from.size && to.pos < to.size) {
    const size_t taken = from.pos, given = to.pos;
    if (ZSTD_isError(ZSTD_decompressStream(context.get(), &to, &from)) != 0) break;
    if (from.pos == taken && to.pos == given) break;
  }
  return to.pos;
}

Decompressed decompressZstd(ByteView compressed, size_t size) {
  Decompressed plain{std::vector<uint8_t>(size), ""};
  const size_t count = ZSTD_decompress(plain.bytes.data(), size, compressed.data, compressed.size);
  if (ZSTD_isError(count) != 0) {
    plain.fault = std::string("zstd: ") + ZSTD_getErrorName(count);
    plain.bytes.resize(decompressZstdBlocks(compressed, plain.bytes));
  } else if (count != size) {
    plain.fault = std::string("zstd: ") + kOtherSize;
    plain.bytes.resize(count);
  }
  return plain;
}

Decompressed decompressLz4(ByteView compressed, size_t size) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(
      context, &LZ4F_freeDecompressionContext);
  Decompressed plain{std::vector<uint8_t>(size), ""};
  size_t from = 0, to = 0;
  while (from < compressed.size && plain.fault.empty()) {
    size_t source = compressed.size - from, target = size - to;
    const size_t result =
        LZ4F_decompress(context, plain.bytes.data() + to, &target, compressed.data + from, &source, nullptr);
    if (LZ4F_isError(result) != 0) {
      plain.fault = std::string("lz4: ") + LZ4F_getErrorName(result);
    } else if (source == 0 && target == 0) {
      break;
    } else {
      from += source;
      to += target;
    }
  }
  if (plain.fault.empty() && (to != size || from != compressed.size))
    plain.fault = std::string("lz4: ") + kOtherSize;
  plain.bytes.resize(to);
  return plain;
}

}  // namespace

Decompressed decompress(const std::string& method, ByteView compressed, size_t size) {
  if (method == "zstd") return decompressZstd(compressed, size);
  if (method == "lz4") return decompressLz4(compressed, size);
  if (!method.empty()) return {{}, "compression '" + method + "' is not read"};
  return {{compressed.data, compressed.data + compressed.size}, compressed.size == size ? "" : kOtherSize};
}

std::optional<size_t> sizeOfZstdFrame(ByteView compressed, size_t most) {
  // The smallest block is a header of three bytes and one that is repeated: what states more is damaged.
  constexpr size_t kSmallestBlock = 4, kMostOfBlock = 128 << 10;
  const size_t possible = compressed.size / kSmallestBlock * kMostOfBlock;
  const unsigned long long size = ZSTD_getFrameContentSize(compressed.data, compressed.size);
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN) return std::nullopt;
  if (size > std::min(most, possible)) return std::nullopt;
  return static_cast<size_t>(size);
}

}  // namespace redbee
