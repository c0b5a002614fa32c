// What a ground station may send: any bytes, in any pieces, at any times, while two objects are shown.
// Input: records of one byte (bits 0 to 6: tens of milliseconds that pass; bit 7: the record is a datagram),
// two bytes of length (big-endian), and so many bytes. A length beyond the end takes what is there.
#include <algorithm>

#include "redbee/mavlink/tracking_camera.hpp"
#include "tests/fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  mavlink::TrackingCamera camera({}, 640, 480, std::nullopt, 1'000'000);
  mavlink::Parser station;
  int64_t host_ns = 50'000'000'000;
  for (int id = 1; size >= 3; id = 3 - id) {
    host_ns += (data[0] & 127) * int64_t{10'000'000};
    const mavlink::TrackedObject still{7, true, mavlink::RelativeBox{0.1, 0.1, 0.2, 0.2},
                                       mavlink::ObjectPlace{}};
    camera.show({still, {id, false, mavlink::RelativeBox{0.5, 0.5, 0.6, 0.6}, std::nullopt}}, host_ns);
    const size_t length = std::min(size - 3, static_cast<size_t>(data[1]) << 8 | data[2]);
    camera.receive(data + 3, length, host_ns, (data[0] & 128) != 0);
    for (const mavlink::Bytes& frame : camera.dueFrames(host_ns)) station.feed(frame.data(), frame.size());
    while (station.next()) {
    }
    // Only who was shown can be picked, and what is sent is whole.
    if (camera.picked().value_or(1) > 7 || station.counters().crc_errors != 0) __builtin_trap();
    data += 3 + length;
    size -= 3 + length;
  }
  return 0;
}
