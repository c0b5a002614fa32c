#include "redbee/mavlink/message_rates.hpp"

#include <algorithm>
#include <iterator>

#include "redbee/mavlink/camera_messages.hpp"
#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/sensor_messages.hpp"

namespace redbee::mavlink {
namespace {

constexpr int64_t kPeriod_ns = 1'000'000'000;
constexpr int kOften = 5;    // times that a message is asked for every second
constexpr int kSeldom = 10;  // then: every so many
constexpr int kGivenUp = 3;  // requests after which an autopilot does not have that message of an IMU

}  // namespace

MessageRates::MessageRates(const AutopilotParameters& parameters) {
  for (const uint32_t id : kImuMessages) wanted_[id].rate_hz = parameters.imu_rate_hz;
  for (const uint32_t id : {AttitudeQuaternion::kId, GimbalDeviceAttitudeStatus::kId}) {
    wanted_[id].rate_hz = parameters.attitude_rate_hz;
  }
  for (const uint32_t id : {GlobalPositionInt::kId, LocalPositionNed::kId, GpsRawInt::kId,
                            DistanceSensor::kId, CameraFovStatus::kId}) {
    wanted_[id].rate_hz = parameters.position_rate_hz;
  }
}

void MessageRates::restart() {
  for (auto& [id, wanted] : wanted_) {
    wanted.asked = 0;
    wanted.comes = false;
  }
  heard_.clear();
  period_ns_.reset();
}

bool MessageRates::isBestImu(uint32_t id) const {
  for (const uint32_t each : kImuMessages) {
    if (each == id) return true;
    const auto heard = heard_.find(each);
    if (wanted_.at(each).comes || (heard != heard_.end() && heard->second > 0)) return false;
  }
  return false;
}

/// Of an IMU's messages: whether those before it were asked for and stayed out.
bool MessageRates::isWanted(uint32_t id) const {
  if (std::find(std::begin(kImuMessages), std::end(kImuMessages), id) == std::end(kImuMessages)) return true;
  for (const uint32_t better : kImuMessages) {
    if (better == id) return true;
    const Wanted& wanted = wanted_.at(better);
    if (wanted.comes || wanted.asked < kGivenUp) return false;
  }
  return true;
}

std::vector<RateRequest> MessageRates::due(int64_t host_ns) {
  std::vector<RateRequest> requests;
  if (period_ns_ && host_ns - *period_ns_ < kPeriod_ns) return requests;
  const double seconds = period_ns_ ? static_cast<double>(host_ns - *period_ns_) * 1e-9 : 1;
  period_ns_ = host_ns;
  std::vector<uint32_t> slow;
  for (auto& [id, wanted] : wanted_) {
    wanted.comes = heard_[id] > 0;
    if (heard_[id] < wanted.rate_hz * seconds / 2) slow.push_back(id);
  }
  for (const uint32_t id : slow) {
    if (!isWanted(id)) continue;
    Wanted& wanted = wanted_[id];
    if (wanted.asked < kOften || wanted.asked % kSeldom == 0) requests.push_back({id, wanted.rate_hz});
    ++wanted.asked;
  }
  heard_.clear();
  return requests;
}

}  // namespace redbee::mavlink
