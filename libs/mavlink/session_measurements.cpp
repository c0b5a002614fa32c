// The members of Session that turn frames into measurements.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "redbee/mavlink/attitude_message.hpp"
#include "redbee/mavlink/session.hpp"

namespace redbee::mavlink {
namespace {

constexpr int64_t kOldest_ns = 1'000'000'000;       // on the way; an older measurement is not of this clock
constexpr int64_t kOtherSilent_ns = 2'000'000'000;  // then the message that says less counts
constexpr int64_t kAhead_ns = 50'000'000;  // of its arrival: what the estimate may be off by, and more

}  // namespace

std::optional<ImuTime> Session::timeOf(uint64_t device_us, int64_t host_ns) {
  if (device_us > TimesyncExchange::kMaxTime_ns / 1000) {
    ++counters_.other_times;
    return std::nullopt;
  }
  const auto mapped_ns = clock_.toHost(static_cast<int64_t>(device_us) * 1000);
  if (!mapped_ns) return std::nullopt;
  if (*mapped_ns < host_ns - kOldest_ns || *mapped_ns > host_ns + kAhead_ns) {
    ++counters_.other_times;
    return std::nullopt;
  }
  return ImuTime(fromNanoseconds(*mapped_ns));
}

std::optional<ImuTime> Session::bootTimeOf(const Frame& frame, uint32_t time_boot_ms, int64_t host_ns) {
  if (!isOfAutopilot(frame)) return ImuTime(fromNanoseconds(host_ns));
  return timeOf(uint64_t{time_boot_ms} * 1000, host_ns);
}

template <typename Message>
void Session::handleImu(const Frame& frame, int64_t host_ns) {
  if (!rates_.isBestImu(frame.id)) return;
  const auto message = frame.message<Message>();
  uint64_t device_us = 0;
  if constexpr (std::is_same_v<Message, ScaledImu2>) {
    device_us = uint64_t{message.time_boot_ms} * 1000;
  } else {
    device_us = message.time_usec;
  }
  const auto time = timeOf(device_us, host_ns);
  auto reading = time ? readingOf(message, *time) : std::nullopt;
  // Repeated samples would count twice.
  if (!reading || (last_imu_ && reading->device_us <= last_imu_->device_us)) return;
  // The estimate of the clock may step back by more than two samples are apart that were sent in one burst.
  if (last_imu_) reading->time = std::max(reading->time, last_imu_->time + Duration(1));
  last_imu_ = *reading;
  measurements_.emplace_back(*reading);
}

void Session::handleSensors(const Frame& frame, int64_t host_ns) {
  // In units of its own from any other.
  if (frame.id == RawImu::kId && autopilot_ != Heartbeat::kArduPilot) return;
  rates_.noteMessage(frame.id);
  const auto noteTimed = [&](const auto& message) {
    if (const auto time = timeOf(uint64_t{message.time_boot_ms} * 1000, host_ns))
      vehicle_.note(message, *time);
  };
  switch (frame.id) {
    case Heartbeat::kId:
      return handleHeartbeat(frame.message<Heartbeat>(), host_ns);
    case HighresImu::kId:
      return handleImu<HighresImu>(frame, host_ns);
    case RawImu::kId:
      return handleImu<RawImu>(frame, host_ns);
    case ScaledImu2::kId:
      return handleImu<ScaledImu2>(frame, host_ns);
    case GpsRawInt::kId:  // its own time is often that of the satellites
      return vehicle_.note(frame.message<GpsRawInt>(), ImuTime(fromNanoseconds(host_ns)));
    case GlobalPositionInt::kId:
      return noteTimed(frame.message<GlobalPositionInt>());
    case LocalPositionNed::kId:
      return noteTimed(frame.message<LocalPositionNed>());
    case AttitudeQuaternion::kId:
      quaternion_ns_ = host_ns;
      return handleAttitude(frame.message<AttitudeQuaternion>(), host_ns);
    case Attitude::kId:  // the same in angles: only where the quaternion does not come
      if (quaternion_ns_ && host_ns - *quaternion_ns_ <= kOtherSilent_ns) return;
      return handleAttitude(quaternionOf(frame.message<Attitude>()), host_ns);
    default:
      return;
  }
}

void Session::handleAttitude(const AttitudeQuaternion& message, int64_t host_ns) {
  const auto time = timeOf(uint64_t{message.time_boot_ms} * 1000, host_ns);
  const auto pose = time ? vehicle_.poseAt(message, *time) : std::nullopt;
  if (pose) measurements_.emplace_back(*pose);
}

void Session::handleCamera(const Frame& frame, int64_t host_ns) {
  const auto append = [&](const auto& measurement) {
    if (measurement) measurements_.emplace_back(*measurement);
  };
  rates_.noteMessage(frame.id);
  if (frame.id == CameraInformation::kId) return vehicle_.note(frame.message<CameraInformation>());
  if (frame.id == CameraFovStatus::kId) {
    const auto message = frame.message<CameraFovStatus>();
    const auto time = bootTimeOf(frame, message.time_boot_ms, host_ns);
    const auto lens = time ? VehicleState::lensOf(message, *time) : std::nullopt;
    if (lens) field_of_view_ns_ = host_ns;
    append(lens);
  } else if (frame.id == CameraSettings::kId) {
    // Says the focal length at the wide end alone, and another number than the field of view does.
    if (field_of_view_ns_) return;
    const auto message = frame.message<CameraSettings>();
    if (const auto time = bootTimeOf(frame, message.time_boot_ms, host_ns)) {
      measurements_.emplace_back(vehicle_.lensOf(message, *time));
    }
  } else if (frame.id == GimbalDeviceAttitudeStatus::kId) {
    gimbal_device_ns_ = host_ns;
    const auto message = frame.message<GimbalDeviceAttitudeStatus>();
    if (const auto time = bootTimeOf(frame, message.time_boot_ms, host_ns))
      append(vehicle_.gimbalOf(message, *time));
  } else if (!gimbal_device_ns_ || host_ns - *gimbal_device_ns_ > kOtherSilent_ns) {
    // The older message says less: only where the newer does not come.
    const auto message = frame.message<MountOrientation>();
    if (const auto time = bootTimeOf(frame, message.time_boot_ms, host_ns))
      append(vehicle_.gimbalOf(message, *time));
  }
}

}  // namespace redbee::mavlink
