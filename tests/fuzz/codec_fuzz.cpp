// Every message type: bytes that decode encode to the same bytes, and images decode or do not.
// Input: one byte that picks the type, then what follows the type's hash.
#include "redbee/altimeter_t.hpp"
#include "redbee/bus/codec.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/filter_snapshot_t.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/ins_t.hpp"
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
void roundTrip(const uint8_t* data, size_t size) {
  Message message;
  roundTrip(data, size, message);
}

}  // namespace
}  // namespace redbee

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  if (size == 0) return 0;
  const uint8_t type = data[0] % 10;
  ++data;
  --size;
  if (type == 0) {
    image_t image;
    if (roundTrip(data, size, image) && image.width <= 256 && image.height <= 256) {
      decodeGrey(image);
      decodeColour(image);
    }
  }
  if (type == 1) roundTrip<ins_t>(data, size);
  if (type == 2) roundTrip<altimeter_t>(data, size);
  if (type == 3) roundTrip<inertial_homography_t>(data, size);
  if (type == 4) roundTrip<visual_homography_t>(data, size);
  if (type == 5) roundTrip<fused_homography_t>(data, size);
  if (type == 6) roundTrip<foreground_t>(data, size);
  if (type == 7) roundTrip<detections_t>(data, size);
  if (type == 8) roundTrip<process_health_t>(data, size);
  if (type == 9) roundTrip<filter_snapshot_t>(data, size);
  return 0;
}
