#include "redbee/node/message_check.hpp"

#include <array>
#include <cstring>

#include "redbee/node/message_limits.hpp"

namespace redbee {
namespace {

using namespace message_limits;  // NOLINT: made for this

constexpr int32_t kMaxPid = 1 << 22;                    // Linux' highest pid_max
constexpr int64_t kMaxCount = 1'000'000'000'000;        // ten kHz for three years
constexpr int64_t kMaxTime_us = 4'000'000'000'000'000;  // the year 2096
constexpr int64_t kMaxResident = int64_t{1} << 48;      // the address space
constexpr double kMaxRate_hz = 1e6;
constexpr double kMaxDuration_ms = 1e7;  // three hours

uint32_t bigEndian32(const uint8_t* data) {
  return uint32_t{data[0]} << 24 | uint32_t{data[1]} << 16 | uint32_t{data[2]} << 8 | uint32_t{data[3]};
}

/// Whether the header is that of a PNG of this size; nothing is decoded.
bool isPng(const std::vector<uint8_t>& data, int32_t width, int32_t height) {
  constexpr std::array<uint8_t, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr size_t kWidthAt = 16;
  return data.size() >= kWidthAt + 8 && std::equal(kSignature.begin(), kSignature.end(), data.begin()) &&
         std::memcmp(data.data() + 12, "IHDR", 4) == 0 &&
         bigEndian32(data.data() + kWidthAt) == static_cast<uint32_t>(width) &&
         bigEndian32(data.data() + kWidthAt + 4) == static_cast<uint32_t>(height);
}

bool isForegroundStatus(int8_t status) {
  return status >= foreground_t::GOOD && status <= foreground_t::BAD_IMAGE;
}

}  // namespace

const char* faultOf(const altimeter_t& m) {
  return firstFault({{isTime(m.utime), "time"},
                     {isFrom(-kMaxLength_m, m.height, kMaxLength_m), "height"},
                     {m.sigma > 0 && isFrom(0, m.sigma, kMaxLength_m), "sigma"}});
}

const char* faultOf(const ins_t& m) {
  return firstFault({{isTime(m.utime), "time"},
                     {areFrom(-kMaxRotationRate, m.gyro, kMaxRotationRate), "rotation rate"},
                     {areFrom(-kMaxAcceleration, m.accel, kMaxAcceleration), "specific force"}});
}

/// The pixels are the decoder's to check (libs/bus/image.hpp).
const char* faultOf(const image_t& m) {
  return firstFault({{isTime(m.utime), "time"}, {hasImageSize(m), "image size"}});
}

const char* faultOf(const image_metadata_t&) { return nullptr; }

const char* faultOf(const detection_t& m) {
  return firstFault({{m.id >= 0, "identity"},
                     {isFrom(-kMaxCoordinate_px, m.x, kMaxCoordinate_px) &&
                          isFrom(-kMaxCoordinate_px, m.y, kMaxCoordinate_px) &&
                          isFrom(0, m.width, kMaxImageSide) && isFrom(0, m.height, kMaxImageSide),
                      "box"},
                     {isFrom(0, m.area, double{kMaxImageSide} * kMaxImageSide), "area"},
                     {isFrom(0, m.score, 1), "score"},
                     {isFlag(m.seen), "flag"}});
}

const char* faultOf(const detections_t& m) {
  const char* fault =
      firstFault({{isTime(m.utime), "time"},
                  {m.sequence >= 0, "sequence"},
                  {isForegroundStatus(m.status), "status"},
                  {isFrom(0, m.n, kMaxDetections) && m.detections.size() == static_cast<size_t>(m.n),
                   "number of detections"}});
  for (size_t i = 0; fault == nullptr && i < m.detections.size(); ++i) fault = faultOf(m.detections[i]);
  return fault;
}

/// Without a decoded image there may be no maps.
const char* faultOf(const foreground_t& m) {
  const bool is_empty =
      m.status != foreground_t::GOOD && m.probability.empty() && m.mask.empty() && m.unknown.empty();
  return firstFault({{hasFrameTimes(m), "time"},
                     {m.sequence >= 0, "sequence"},
                     {isForegroundStatus(m.status), "status"},
                     {is_empty || hasImageSize(m), "image size"},
                     {is_empty || isPng(m.probability, m.width, m.height), "probability"},
                     {is_empty || isPng(m.mask, m.width, m.height), "mask"},
                     {is_empty || isPng(m.unknown, m.width, m.height), "unknown pixels"}});
}

const char* faultOf(const process_health_t& h) {
  const std::array counts{h.received, h.published, h.skipped, h.lost, h.damaged, h.late};
  const std::array rates{h.rate_in, h.rate_out};
  const std::array durations{h.latency_median, h.latency_p99, h.work_median, h.work_p99, h.work_mean};
  const std::array texts{&h.process, &h.message, &h.version, &h.configuration, &h.calibration};
  return firstFault(
      {{isFrom(0, h.utime, kMaxTime_us), "time"},
       {isFrom(process_health_t::STARTING, h.state, process_health_t::DEAD), "state"},
       {h.pid > 0 && h.pid <= kMaxPid, "process number"},
       {h.sequence >= 0, "sequence"},
       {isFrom(0, h.resident, kMaxResident), "memory"},
       {std::all_of(counts.begin(), counts.end(), [](int64_t n) { return isFrom(0, n, kMaxCount); }),
        "counts"},
       {std::all_of(rates.begin(), rates.end(), [](double r) { return isFrom(0, r, kMaxRate_hz); }), "rates"},
       {std::all_of(durations.begin(), durations.end(),
                    [](double d) { return isFrom(0, d, kMaxDuration_ms); }),
        "durations"},
       {std::all_of(texts.begin(), texts.end(), [](const auto* text) { return isTextShort(*text); }),
        "text"}});
}

}  // namespace redbee
