#include "redbee/files/decompress.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <memory>
#include <stdexcept>

namespace redbee {
namespace {

std::vector<uint8_t> decompressZstd(ByteView compressed, size_t size) {
  std::vector<uint8_t> plain(size);
  const size_t count = ZSTD_decompress(plain.data(), plain.size(), compressed.data, compressed.size);
  if (ZSTD_isError(count) != 0) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(count));
  if (count != size) throw std::runtime_error("zstd: gives another size than stated");
  return plain;
}

std::vector<uint8_t> decompressLz4(ByteView compressed, size_t size) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(
      context, &LZ4F_freeDecompressionContext);
  std::vector<uint8_t> plain(size);
  size_t from = 0, to = 0;
  while (from < compressed.size) {
    size_t source = compressed.size - from, target = plain.size() - to;
    const size_t result =
        LZ4F_decompress(context, plain.data() + to, &target, compressed.data + from, &source, nullptr);
    if (LZ4F_isError(result) != 0) throw std::runtime_error(std::string("lz4: ") + LZ4F_getErrorName(result));
    if (source == 0 && target == 0) break;
    from += source;
    to += target;
  }
  if (to != size || from != compressed.size) throw std::runtime_error("lz4: gives another size than stated");
  return plain;
}

}  // namespace

std::vector<uint8_t> decompress(const std::string& method, ByteView compressed, size_t size) {
  if (method == "zstd") return decompressZstd(compressed, size);
  if (method == "lz4") return decompressLz4(compressed, size);
  if (!method.empty()) throw std::runtime_error("compression '" + method + "' is not read");
  if (compressed.size != size) throw std::runtime_error("has another size than stated");
  return {compressed.data, compressed.data + size};
}

}  // namespace redbee
