// What an autopilot's link may bring: any bytes, in any pieces, at any times.
// Input: records of one byte (bits 0 to 6: milliseconds that pass; bit 7: the record is a datagram), two
// bytes of length (big-endian), and so many bytes. A length beyond the end takes what is there. A first byte
// of 1 has a signing key follow.
#include <algorithm>
#include <variant>

#include "redbee/mavlink/session.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace redbee::fuzz {
namespace {

using mavlink::Measurement;

/// Whatever arrives, what comes out is finite and of our time.
void require(const Measurement& measurement, int64_t host_ns) {
  const auto is_near = [&](ImuTime time) {
    return toUtime(time) <= host_ns / 1000 + 60'000 && toUtime(time) >= host_ns / 1000 - 1'100'000;
  };
  bool holds = true;
  if (const auto* imu = std::get_if<mavlink::ImuReading>(&measurement)) {
    holds = imu->gyro.allFinite() && imu->accel.allFinite() && is_near(imu->time);
  } else if (const auto* pose = std::get_if<mavlink::Pose>(&measurement)) {
    holds = pose->enu_from_flu.coeffs().allFinite() && is_near(pose->time);
  } else if (const auto* height = std::get_if<mavlink::HeightReading>(&measurement)) {
    holds = height->sigma_m > 0 && is_near(height->time);
  }
  if (!holds) __builtin_trap();
}

}  // namespace
}  // namespace redbee::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  const bool is_signed = size > 0 && data[0] == 1;
  if (size > 0) ++data, --size;
  const auto key = is_signed ? std::optional(mavlink::SigningKey{}) : std::nullopt;
  mavlink::Session session({}, key, 1'000'000);
  int64_t host_ns = 50'000'000'000;
  while (size >= 3) {
    host_ns += (data[0] & 127) * int64_t{1'000'000};
    session.dueFrames(host_ns);
    const size_t length = std::min(size - 3, static_cast<size_t>(data[1]) << 8 | data[2]);
    for (const auto& each : session.receive(data + 3, length, host_ns, (data[0] & 128) != 0)) {
      fuzz::require(each, host_ns);
    }
    data += 3 + length;
    size -= 3 + length;
  }
  return 0;
}
