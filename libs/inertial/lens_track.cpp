#include "redbee/inertial/lens_track.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "redbee/inertial/sample_track.hpp"

namespace redbee {
namespace {

constexpr double kFastLens = 0.5;      // 1/s, of the logarithm: a servo takes some seconds for its range
constexpr double kLongestGuess_s = 4;  // s: then it may have passed its whole range

}  // namespace

std::optional<double> zoomOf(const StatedZoom& stated, double fx_px, const LensParameters& parameters) {
  const bool has_range = stated.range && parameters.zoom_range > 0;
  // A maker's number at the wide end is not the calibrated one: the zoom would leap from it to the range's
  // place.
  const bool is_comparable = parameters.focal_length_px > 0 || !has_range;
  if (stated.focal_px && is_comparable) {
    return *stated.focal_px / (parameters.focal_length_px > 0 ? parameters.focal_length_px : fx_px);
  }
  if (has_range) return 1 + (parameters.zoom_range - 1) * *stated.range;
  return std::nullopt;
}

bool LensTrack::add(const LensSample& sample) {
  const bool is_lens = std::isfinite(sample.zoom) && sample.zoom <= kMostZoom && sample.zoom * kMostZoom >= 1;
  if (!isPlausibleTime(sample.time) || !is_lens) return false;
  insertInOrder(samples_, LensSample{sample.time + shift_, sample.zoom});
  return true;
}

bool LensTrack::areSame(const LensSample& a, const LensSample& b) const {
  constexpr double kSigmas = 3;
  return std::abs(std::log(b.zoom / a.zoom)) <= kSigmas * parameters_.focal_sigma &&
         seconds(b.time - a.time) <= kLongestGuess_s;
}

bool LensTrack::standsStillAt(ImuTime time) const {
  constexpr double kOverdue = 1.5;  // times the time between the last two
  if (samples_.size() < 2) return false;
  const LensSample &last = samples_.back(), &before = samples_[samples_.size() - 2];
  const double apart_s = seconds(last.time - before.time);
  return apart_s > parameters_.max_gap_s && areSame(before, last) && time >= last.time &&
         seconds(time - last.time) <= kOverdue * apart_s;
}

bool LensTrack::reaches(ImuTime time) const {
  return (!samples_.empty() && samples_.back().time >= time) || standsStillAt(time);
}

Zoom LensTrack::guess(double zoom, double away_s) const {
  const double moved = std::hypot(parameters_.focal_sigma, kFastLens * std::min(away_s, kLongestGuess_s));
  return {zoom, moved * moved, false};
}

Zoom LensTrack::guessedBy(const LensSample& nearest, ImuTime time) const {
  return guess(nearest.zoom, std::abs(seconds(time - nearest.time)));
}

Zoom LensTrack::at(ImuTime time) const {
  if (samples_.empty()) return guess(1, kLongestGuess_s);
  const double variance = parameters_.focal_sigma * parameters_.focal_sigma;
  const auto later = firstFrom(samples_, time);
  if (later == samples_.end()) {
    if (standsStillAt(time)) return {samples_.back().zoom, variance, true};
    return guessedBy(samples_.back(), time);
  }
  if (later->time == time) return {later->zoom, variance, true};
  if (later == samples_.begin()) return guessedBy(*later, time);
  const LensSample& first = *std::prev(later);
  const double apart_s = seconds(later->time - first.time);
  if (apart_s > parameters_.max_gap_s && !areSame(first, *later))
    return guessedBy(later->time - time < time - first.time ? *later : first, time);
  const double fraction = seconds(time - first.time) / apart_s;
  return {first.zoom * std::exp(fraction * std::log(later->zoom / first.zoom)), variance, true};
}

void LensTrack::eraseBefore(ImuTime time) {
  constexpr size_t kToStandStill = 2;  // it takes as many to see that the lens does
  eraseUpTo(samples_, time, kToStandStill);
}

}  // namespace redbee
