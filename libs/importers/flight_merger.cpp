#include "redbee/importers/flight_merger.hpp"

#include <algorithm>
#include <iterator>

#include "redbee/altimeter_t.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/gimbal_t.hpp"
#include "redbee/importers/impossible_values.hpp"
#include "redbee/importers/imu_check.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/lens_t.hpp"

namespace redbee {
namespace {

ins_t toMessage(const ImuSample& sample) {
  ins_t message{};
  message.utime = toUtime(sample.time);
  message.device_time = toUtime(sample.time);
  std::copy_n(sample.gyro.data(), 3, message.gyro);
  std::copy_n(sample.accel.data(), 3, message.accel);
  message.quat[0] = 1;
  return message;
}

altimeter_t toMessage(const AltitudeSample& sample) {
  altimeter_t message{};
  message.utime = toUtime(sample.time);
  message.height = sample.height_m;
  message.sigma = sample.sigma_m;
  return message;
}

gimbal_t toMessage(const MountSample& sample) {
  gimbal_t message{};
  message.utime = toUtime(sample.time);
  message.has_body = 1;
  const double ordered[] = {sample.q_IM.w(), sample.q_IM.x(), sample.q_IM.y(), sample.q_IM.z()};
  std::copy(std::begin(ordered), std::end(ordered), std::begin(message.quat_body));
  return message;
}

lens_t toMessage(const StatedLens& lens) {
  lens_t message{};
  message.utime = toUtime(lens.time);
  message.has_focal_length = 1;
  message.focal_length = lens.focal_px;
  message.width = lens.width;
  return message;
}

}  // namespace

FlightMerger::FlightMerger(const std::filesystem::path& log, ImportChannels channels,
                           std::vector<ImuSample> imu, std::vector<AltitudeSample> altitudes)
    : log_(log), channels_(std::move(channels)), imu_(std::move(imu)), altitudes_(std::move(altitudes)) {
  for (const std::string& line : {leaveOutImpossible(imu_), leaveOutImpossible(altitudes_)}) {
    if (!line.empty()) left_out_.push_back(line);
  }
}

void FlightMerger::addFrame(const image_t& frame) {
  writeUpTo(fromUtime(frame.utime));
  log_.write(channels_.camera, frame);
  if (frames_++ == 0) first_utime_ = frame.utime;
  last_utime_ = frame.utime;
}

void FlightMerger::requirePlausibleImu(const std::filesystem::path& file, const ImuUnits& units) {
  imu_file_ = file;
  units_ = units;
}

void FlightMerger::check(ImportSummary& summary) const {
  const ImuFindings findings =
      checkImu(imu_, CameraTime(fromUtime(first_utime_)), CameraTime(fromUtime(last_utime_)), units_);
  if (imu_file_ && !findings.faults.empty()) throw InputError(*imu_file_, findings.faults.front());
  for (const auto* lines : {&left_out_, &findings.faults, &findings.warnings})
    summary.warnings.insert(summary.warnings.end(), lines->begin(), lines->end());
}

void FlightMerger::close(ImportSummary& summary) {
  check(summary);
  writeUpTo(Duration::max());
  log_.close();
  summary.frames = frames_;
  summary.imu_samples = static_cast<int64_t>(imu_.size());
  summary.altitudes = static_cast<int64_t>(altitudes_.size());
  summary.first_utime = first_utime_;
  summary.last_utime = last_utime_;
  summary.imu_rate_hz = meanRate(imu_);
  summary.vehicle.has_imu = !imu_.empty();
}

void FlightMerger::writeUpTo(Duration time) {
  const auto due = [limit = ImuTime(time)](const auto& samples, size_t next) {
    return next < samples.size() && samples[next].time <= limit;
  };
  while (due(mount_, next_mount_)) log_.write(channels_.gimbal, toMessage(mount_[next_mount_++]));
  while (due(lens_, next_lens_)) log_.write(channels_.lens, toMessage(lens_[next_lens_++]));
  while (due(imu_, next_imu_) || due(altitudes_, next_altitude_)) {
    const bool imu_first = due(imu_, next_imu_) && (!due(altitudes_, next_altitude_) ||
                                                    imu_[next_imu_].time <= altitudes_[next_altitude_].time);
    if (imu_first) {
      log_.write(channels_.imu, toMessage(imu_[next_imu_++]));
    } else {
      log_.write(channels_.altimeter, toMessage(altitudes_[next_altitude_++]));
    }
  }
}

}  // namespace redbee
