// Every message type: bytes that decode encode to the same bytes, and images decode or do not.
// Input: one byte that picks the type, then what follows the type's hash.
#include "redbee/bus/codec.hpp"
#include "redbee/bus/image.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace redbee {
namespace {

template <typename Message>
std::vector<uint8_t> behindHash(const uint8_t* data, size_t size) {
  const auto hash = static_cast<uint64_t>(Message::getHash());
  std::vector<uint8_t> bytes;
  for (int shift = 56; shift >= 0; shift -= 8) bytes.push_back(static_cast<uint8_t>(hash >> shift));
  bytes.insert(bytes.end(), data, data + size);
  return bytes;
}

template <typename Message>
bool roundTrip(const uint8_t* data, size_t size, Message& message) {
  const std::vector<uint8_t> bytes = behindHash<Message>(data, size);
  if (!decodeMessage(bytes.data(), static_cast<int>(bytes.size()), message)) return false;
  if (encodeMessage(message) != bytes) __builtin_trap();
  return true;
}
template <typename Message>
void check(const uint8_t* data, size_t size) {
  Message message;
  roundTrip(data, size, message);
}
template <>
void check<image_t>(const uint8_t* data, size_t size) {
  image_t image;
  if (!roundTrip(data, size, image) || image.width > 256 || image.height > 256) return;
  decodeGrey(image);
  decodeColour(image);
}

template <typename... Messages>
void checkPicked(uint8_t pick, const uint8_t* data, size_t size, TypeList<Messages...>) {
  using Check = void (*)(const uint8_t*, size_t);
  constexpr Check kChecks[] = {check<Messages>...};
  kChecks[pick % sizeof...(Messages)](data, size);
}

}  // namespace
}  // namespace redbee

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size > 0) redbee::checkPicked(data[0], data + 1, size - 1, redbee::MessageTypes{});
  return 0;
}
