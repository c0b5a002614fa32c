#include "redbee/inertial/imu_buffer.hpp"

#include <algorithm>
#include <cmath>

namespace redbee {
namespace {

constexpr std::size_t kMaxSamples = 8192;

bool isEarlier(const ImuSample& sample, ImuTime time) { return sample.time < time; }
bool isLater(ImuTime time, const ImuSample& sample) { return time < sample.time; }

}  // namespace

bool ImuBuffer::isFar(ImuTime a, ImuTime b) const {
  return std::abs(static_cast<double>((a - b).count())) > clock_jump_us_;
}

void ImuBuffer::add(const ImuSample& sample) {
  if (samples_.empty() || !isFar(sample.time, newest())) {
    insert(sample);
    suspect_.reset();
  } else if (suspect_ && suspect_->time != sample.time && !isFar(sample.time, suspect_->time)) {
    samples_.clear();
    insert(*suspect_);
    insert(sample);
    suspect_.reset();
  } else {
    suspect_ = sample;
  }
}

void ImuBuffer::insert(const ImuSample& sample) {
  const auto place = std::lower_bound(samples_.begin(), samples_.end(), sample.time, isEarlier);
  if (place != samples_.end() && place->time == sample.time) return;
  samples_.insert(place, sample);
  if (samples_.size() > kMaxSamples) samples_.pop_front();
}

ImuSample ImuBuffer::at(ImuTime time) const {
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), time, isEarlier);
  if (after == samples_.begin()) return {time, after->gyro, after->accel};
  const ImuSample& before = *(after - 1);
  if (after == samples_.end()) return {time, before.gyro, before.accel};
  const double fraction = seconds(time - before.time) / seconds(after->time - before.time);
  return {time, before.gyro + fraction * (after->gyro - before.gyro),
          before.accel + fraction * (after->accel - before.accel)};
}

ImuSpan ImuBuffer::span(ImuTime begin, ImuTime end) const {
  ImuSpan span;
  const auto first = std::upper_bound(samples_.begin(), samples_.end(), begin, isLater);
  const auto last = std::upper_bound(first, samples_.end(), end, isLater);
  span.measured = static_cast<int>(last - first);

  ImuTime before = first == samples_.begin() ? begin : (first - 1)->time;
  span.knots.push_back({at(begin), 0});
  for (auto sample = first; sample != last; ++sample) {
    span.knots.push_back({*sample, seconds(sample->time - before)});
    before = sample->time;
  }
  const bool reaches_beyond = last != samples_.end();
  if (span.knots.back().sample.time < end) {
    span.knots.push_back({at(end), seconds((reaches_beyond ? last->time : end) - before)});
  }
  for (const ImuKnot& knot : span.knots) span.longest_gap_s = std::max(span.longest_gap_s, knot.gap_s);
  if (!reaches_beyond) span.extrapolated_s += seconds(std::max(Duration(0), end - newest()));
  span.extrapolated_s += seconds(std::max(Duration(0), samples_.front().time - begin));
  return span;
}

std::vector<ImuSample> ImuBuffer::samplesOn(ImuTime begin, ImuTime end) const {
  const auto first = std::lower_bound(samples_.begin(), samples_.end(), begin, isEarlier);
  return {first, std::upper_bound(first, samples_.end(), end, isLater)};
}

void ImuBuffer::eraseBefore(ImuTime time) {
  while (samples_.size() > 1 && samples_[1].time <= time) samples_.pop_front();
}

}  // namespace redbee
