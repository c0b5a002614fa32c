#include "processes/health_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "redbee/configuration/process_table.hpp"

namespace redbee {
namespace {

constexpr int32_t kMaxPid = 1 << 22;                    // Linux' highest pid_max
constexpr int64_t kMaxCount = 1'000'000'000'000;        // ten kHz for three years
constexpr int64_t kMaxTime_us = 4'000'000'000'000'000;  // the year 2096
constexpr int64_t kMaxResident = int64_t{1} << 48;      // the address space
constexpr double kMaxRate_hz = 1e6;
constexpr double kMaxDuration_ms = 1e7;  // three hours
constexpr size_t kMaxText = 1024;

bool isFrom(double low, double value, double high) {
  return std::isfinite(value) && low <= value && value <= high;
}
bool isFrom(int64_t low, int64_t value, int64_t high) { return low <= value && value <= high; }

}  // namespace

bool isPlausible(const process_health_t& h) {
  const std::array counts{h.received, h.published, h.skipped, h.lost, h.damaged, h.late};
  const std::array rates{h.rate_in, h.rate_out};
  const std::array durations{h.latency_median, h.latency_p99, h.work_median, h.work_p99, h.work_mean};
  const std::array texts{&h.process, &h.message, &h.version, &h.configuration, &h.calibration};
  return h.state >= process_health_t::STARTING && h.state <= process_health_t::DEAD &&  //
         h.pid > 0 && h.pid <= kMaxPid && h.sequence >= 0 &&                            //
         isFrom(int64_t{0}, h.utime, kMaxTime_us) && isFrom(int64_t{0}, h.resident, kMaxResident) &&
         std::all_of(counts.begin(), counts.end(),
                     [](int64_t n) { return isFrom(int64_t{0}, n, kMaxCount); }) &&
         std::all_of(rates.begin(), rates.end(), [](double r) { return isFrom(0.0, r, kMaxRate_hz); }) &&
         std::all_of(durations.begin(), durations.end(),
                     [](double d) { return isFrom(0.0, d, kMaxDuration_ms); }) &&
         std::all_of(texts.begin(), texts.end(), [](const auto* text) { return text->size() <= kMaxText; });
}

bool isKnownProcess(const std::string& name) {
  const auto has_name = [&](const ProcessDescription* process) { return programName(*process) == name; };
  return std::any_of(kStages.begin(), kStages.end(), has_name) ||
         std::any_of(kSupportProcesses.begin(), kSupportProcesses.end(), has_name);
}

}  // namespace redbee
