#include "redbee/inertial/imu_sample_check.hpp"

#include <algorithm>
#include <cmath>

namespace redbee {
namespace {

constexpr double kFarInUsual = 10;      // a spike differs by so many usual differences
constexpr double kMemorySamples = 100;  // memory of the usual difference
constexpr double kMostInLimits = 4;     // bound on one difference: a spike must not mask the next
constexpr double kNeighbour_s = 0.05;   // samples further apart are not compared
constexpr double kLate_s = 1.0;         // a sample that is older than that by more: time was set back
constexpr double kFullRange = 0.999;
constexpr std::size_t kMaxRefused = 8192;

}  // namespace

double ImuSampleCheck::Channel::limit() const { return std::max(floor, kFarInUsual * usual); }

void ImuSampleCheck::Channel::note(double difference) {
  usual += (std::min(difference, kMostInLimits * limit()) - usual) / kMemorySamples;
}

bool ImuSampleCheck::Channel::isStuck(bool same, ImuTime time) {
  if (!same) {
    same_since = time;
    same_count = 0;
    return false;
  }
  return ++same_count >= kStuckSamples && seconds(time - same_since) > kStuckFor_s;
}

bool ImuSampleCheck::isSaturated(const ImuSample& sample) const {
  return sample.gyro.cwiseAbs().maxCoeff() >= kFullRange * limits_.gyro_range ||
         sample.accel.cwiseAbs().maxCoeff() >= kFullRange * limits_.accel_range;
}

bool ImuSampleCheck::isStuck(const ImuSample& sample) {
  const bool gyro = gyro_.isStuck(previous_ && previous_->gyro == sample.gyro, sample.time);
  const bool accel = accel_.isStuck(previous_ && previous_->accel == sample.accel, sample.time);
  return gyro || accel;
}

double ImuSampleCheck::distance(const ImuSample& a, const ImuSample& b) const {
  return std::max((a.gyro - b.gyro).norm() / gyro_.limit(), (a.accel - b.accel).norm() / accel_.limit());
}

std::vector<ImuSample> ImuSampleCheck::filter(const ImuSample& sample) {
  std::vector<ImuSample> accepted;
  const double since = previous_ ? seconds(sample.time - previous_->time) : kNeighbour_s + 1;
  if (isSaturated(sample)) {
    refuse(sample.time);
    return accepted;
  }
  if (since <= 0 && since > -kLate_s) {
    if (!isRefused(sample.time)) accepted.push_back(sample);
    return accepted;
  }
  if (since <= 0 || since > kNeighbour_s) {
    startAt(sample);
    return {sample};
  }
  const bool stuck = isStuck(sample);
  gyro_.note((sample.gyro - previous_->gyro).norm());
  accel_.note((sample.accel - previous_->accel).norm());
  previous_ = sample;
  if (stuck) {
    refuse(sample.time);
    return accepted;
  }
  if (held_) {
    const bool continues = distance(*held_, sample) <= distance(*accepted_, sample);
    if (continues) {
      accepted.push_back(*held_);
      accepted_ = held_;
    } else {
      refuse(held_->time);
    }
    held_.reset();
  }
  acceptOrHold(sample, accepted);
  return accepted;
}

/// After a gap, or when the clock was set back: there is no previous sample to compare with.
void ImuSampleCheck::startAt(const ImuSample& sample) {
  if (held_) refuse(held_->time);
  held_.reset();
  previous_ = accepted_ = sample;
  for (Channel* channel : {&gyro_, &accel_}) {
    channel->same_count = 0;
    channel->same_since = sample.time;
  }
}

bool ImuSampleCheck::isRefused(ImuTime time) const {
  return (held_ && held_->time == time) ||
         std::find(refused_.begin(), refused_.end(), time) != refused_.end();
}

void ImuSampleCheck::acceptOrHold(const ImuSample& sample, std::vector<ImuSample>& accepted) {
  if (distance(*accepted_, sample) > 1) {
    held_ = sample;
    return;
  }
  accepted_ = sample;
  accepted.push_back(sample);
}

void ImuSampleCheck::refuse(ImuTime time) {
  refused_.push_back(time);
  if (refused_.size() > kMaxRefused) refused_.pop_front();
}

int ImuSampleCheck::refusedOn(ImuTime begin, ImuTime end) const {
  return static_cast<int>(std::count_if(refused_.begin(), refused_.end(),
                                        [&](ImuTime time) { return time > begin && time <= end; }));
}

void ImuSampleCheck::eraseBefore(ImuTime time) {
  const auto old = [&](ImuTime refused) { return refused < time; };
  refused_.erase(std::remove_if(refused_.begin(), refused_.end(), old), refused_.end());
}

}  // namespace redbee
