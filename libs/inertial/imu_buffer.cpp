#include "redbee/inertial/imu_buffer.hpp"

#include <algorithm>
#include <cmath>

#include "redbee/inertial/seconds.hpp"

namespace redbee {
namespace {

constexpr std::size_t kMaxSamples = 8192;

bool isEarlier(const ImuSample& sample, int64_t utime) { return sample.utime < utime; }
bool isLater(int64_t utime, const ImuSample& sample) { return utime < sample.utime; }

}  // namespace

bool isPlausibleTime(int64_t utime) { return utime > -kMaxUtime && utime < kMaxUtime; }

bool ImuBuffer::isFar(int64_t a, int64_t b) const {
  return std::abs(static_cast<double>(a - b)) > clock_jump_us_;
}

void ImuBuffer::add(const ImuSample& sample) {
  if (samples_.empty() || !isFar(sample.utime, newest())) {
    insert(sample);
    suspect_.reset();
  } else if (suspect_ && suspect_->utime != sample.utime && !isFar(sample.utime, suspect_->utime)) {
    samples_.clear();
    insert(*suspect_);
    insert(sample);
    suspect_.reset();
  } else {
    suspect_ = sample;
  }
}

void ImuBuffer::insert(const ImuSample& sample) {
  const auto place = std::lower_bound(samples_.begin(), samples_.end(), sample.utime, isEarlier);
  if (place != samples_.end() && place->utime == sample.utime) return;
  samples_.insert(place, sample);
  if (samples_.size() > kMaxSamples) samples_.pop_front();
}

ImuSample ImuBuffer::at(int64_t utime) const {
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), utime, isEarlier);
  if (after == samples_.begin()) return {utime, after->gyro, after->accel};
  const ImuSample& before = *(after - 1);
  if (after == samples_.end()) return {utime, before.gyro, before.accel};
  const double fraction = seconds(utime - before.utime) / seconds(after->utime - before.utime);
  return {utime, before.gyro + fraction * (after->gyro - before.gyro),
          before.accel + fraction * (after->accel - before.accel)};
}

ImuSpan ImuBuffer::span(int64_t begin, int64_t end) const {
  ImuSpan span;
  const auto first = std::upper_bound(samples_.begin(), samples_.end(), begin, isLater);
  const auto last = std::upper_bound(first, samples_.end(), end, isLater);
  span.measured = static_cast<int>(last - first);

  int64_t before = first == samples_.begin() ? begin : (first - 1)->utime;
  span.knots.push_back({at(begin), 0});
  for (auto sample = first; sample != last; ++sample) {
    span.knots.push_back({*sample, seconds(sample->utime - before)});
    before = sample->utime;
  }
  const bool reaches_beyond = last != samples_.end();
  if (span.knots.back().sample.utime < end) {
    span.knots.push_back({at(end), seconds((reaches_beyond ? last->utime : end) - before)});
  }
  for (const ImuKnot& knot : span.knots) span.longest_hole_s = std::max(span.longest_hole_s, knot.hole_s);
  if (!reaches_beyond) span.extrapolated_s += seconds(std::max<int64_t>(0, end - newest()));
  span.extrapolated_s += seconds(std::max<int64_t>(0, samples_.front().utime - begin));
  return span;
}

std::vector<ImuSample> ImuBuffer::samplesOn(int64_t begin, int64_t end) const {
  const auto first = std::lower_bound(samples_.begin(), samples_.end(), begin, isEarlier);
  return {first, std::upper_bound(first, samples_.end(), end, isLater)};
}

void ImuBuffer::eraseBefore(int64_t utime) {
  while (samples_.size() > 1 && samples_[1].utime <= utime) samples_.pop_front();
}

}  // namespace redbee
