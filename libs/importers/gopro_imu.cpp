#include "redbee/importers/gopro_imu.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "redbee/importers/gpmf.hpp"
#include "redbee/importers/impossible_values.hpp"

namespace redbee {
namespace {

/// One payload's samples of a sensor with the container's time.
struct Batch {
  GpmfSamples samples;
  double start_s = 0;
  double duration_s = 0;
  int64_t before = 0;  ///< samples since the recording began, this batch's excluded
};

std::vector<Batch> batches(const std::vector<DataPacket>& packets, const std::string& key) {
  std::vector<Batch> out;
  int64_t counted = 0;
  for (const DataPacket& packet : packets) {
    std::vector<GpmfSamples> found = gpmfSensor(packet.bytes, key);
    if (found.empty() || found.front().values.empty()) continue;
    Batch batch;
    batch.samples = std::move(found.front());
    batch.start_s = packet.start_s;
    batch.duration_s = packet.duration_s;
    const auto count = static_cast<int64_t>(batch.samples.values.size());
    batch.before = batch.samples.total_after ? *batch.samples.total_after - count : counted;
    // A count that decreases belongs to a restarted counter: continue from our own.
    if (batch.before < counted && !out.empty()) batch.before = counted;
    counted = batch.before + count;
    out.push_back(std::move(batch));
  }
  if (out.empty()) throw GpmfError("GPMF track holds no " + key + " samples");
  return out;
}

struct Line {
  double offset = 0;
  double slope = 0;
};

/// Least squares.
Line fitLine(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0;
  double mean_y = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  double xy = 0;
  double xx = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    xx += (x[i] - mean_x) * (x[i] - mean_x);
  }
  const double slope = xy / xx;
  return {mean_y - slope * mean_x, slope};
}

bool allStamped(const std::vector<Batch>& all) {
  return std::all_of(all.begin(), all.end(),
                     [](const Batch& batch) { return batch.samples.stamp_s.has_value(); });
}

/// The recorder's stamps against the video's clock, averaged over the whole recording.
double stampOffset(const std::vector<Batch>& all) {
  double sum = 0;
  for (const Batch& batch : all) sum += batch.start_s - *batch.samples.stamp_s;
  return sum / static_cast<double>(all.size());
}

/// Time of sample n of the recording.
Line sampleClock(const std::vector<Batch>& all, const std::optional<double>& stamp_offset) {
  const Batch& first = all.front();
  if (all.size() < 2) {
    const double period = first.duration_s / static_cast<double>(first.samples.values.size());
    if (!(period > 0))
      throw GpmfError("GPMF track has one payload without a duration: its samples have no times");
    return {first.start_s - period * static_cast<double>(first.before), period};
  }
  std::vector<double> index;
  std::vector<double> time;
  for (const Batch& batch : all) {
    index.push_back(static_cast<double>(batch.before));
    time.push_back(stamp_offset ? *batch.samples.stamp_s + *stamp_offset : batch.start_s);
  }
  const Line line = fitLine(index, time);
  if (!(line.slope > 0) || !std::isfinite(line.offset))
    throw GpmfError("GPMF track's sample counts do not grow with time");
  return line;
}

double unitFactor(const GpmfSamples& samples, const std::string& key) {
  const std::string& unit = samples.unit;
  const bool gyro = key == "GYRO";
  if (unit.empty() || unit == (gyro ? "rad/s" : "m/s\xB2") || unit == "m/s\xC2\xB2" ||
      (!gyro && unit == "m/s2"))
    return 1;
  if (gyro && unit == "deg/s") return M_PI / 180;
  if (!gyro && unit == "g") return 9.80665;
  throw GpmfError(key + " has a unit that is not known: '" + unit + "'");
}

Eigen::Vector3d toImuFrame(const GpmfSamples& samples, const std::array<double, 3>& value) {
  const auto axis = [&](char name) {
    const size_t index = samples.axes.find(name);
    if (index == std::string::npos) throw GpmfError("GPMF axes '" + samples.axes + "' are not X, Y and Z");
    return value.at(index);
  };
  return {-axis('Y'), axis('X'), axis('Z')};
}

/// Seconds of the recorder's clock in one of the video's; 1 where it is not stamped.
double recorderSpeed(const std::vector<Batch>& all) {
  if (all.size() < 2 || !allStamped(all)) return 1;
  std::vector<double> video;
  std::vector<double> recorder;
  for (const Batch& batch : all) {
    video.push_back(batch.start_s);
    recorder.push_back(*batch.samples.stamp_s);
  }
  const double speed = fitLine(video, recorder).slope;
  return std::isfinite(speed) ? speed : 1;
}

std::vector<TimedVector> timed(const std::vector<Batch>& all, const std::string& key,
                               const std::optional<double>& stamp_offset) {
  const Line clock = sampleClock(all, stamp_offset);
  std::vector<TimedVector> out;
  for (const Batch& batch : all) {
    const double factor = unitFactor(batch.samples, key);
    for (size_t i = 0; i < batch.samples.values.size(); ++i) {
      const double t_s =
          clock.offset + clock.slope * static_cast<double>(batch.before + static_cast<int64_t>(i));
      out.push_back({t_s, factor * toImuFrame(batch.samples, batch.samples.values[i])});
    }
  }
  return out;
}

/// Before the streams are joined, so that an interpolation mixes nothing in.
void leaveOutImpossible(std::vector<TimedVector>& stream, bool (*isPossible)(const Eigen::Vector3d&),
                        const std::string& key, std::string& damage) {
  const auto isWrong = [&](const TimedVector& each) { return !isPossible(each.value); };
  const auto first = std::find_if(stream.begin(), stream.end(), isWrong);
  if (first == stream.end()) return;
  const auto wrong = std::count_if(first, stream.end(), isWrong);
  const std::string what =
      fmt::format("{} of {} {} samples are beyond what any sensor measures", wrong, stream.size(), key);
  if (static_cast<double>(wrong) > kMostImpossible * static_cast<double>(stream.size()))
    throw GpmfError(what + ": import it as a video");
  damage += fmt::format("{}{}, the first at {:.3f} s: they are left out", damage.empty() ? "" : "; ", what,
                        first->t_s);
  stream.erase(std::remove_if(first, stream.end(), isWrong), stream.end());
}

}  // namespace

GoproStreams readGoproStreams(const std::vector<DataPacket>& packets) {
  const std::vector<Batch> gyro = batches(packets, "GYRO");
  const std::vector<Batch> accel = batches(packets, "ACCL");
  // Both sensors share the recorder's clock, so they share its offset: their stamps stay exact against each
  // other.
  std::optional<double> offset;
  if (allStamped(gyro) && allStamped(accel)) offset = (stampOffset(gyro) + stampOffset(accel)) / 2;
  GoproStreams streams{timed(gyro, "GYRO", offset), timed(accel, "ACCL", offset), {}};
  leaveOutImpossible(streams.gyro, isPossibleTurn, "GYRO", streams.damage);
  leaveOutImpossible(streams.accel, isPossibleForce, "ACCL", streams.damage);
  return streams;
}

std::optional<std::string> reasonToLeaveOut(const std::vector<DataPacket>& packets) {
  const std::vector<Batch> gyro = batches(packets, "GYRO");
  const std::string advice = ", as in time lapse or slow motion: record at normal speed to use the IMU";
  const double speed = recorderSpeed(gyro);
  if (std::abs(speed - 1) > 0.05) {
    return fmt::format("the IMU is left out: a second of the video is {:.3g} s of the motion track{}", speed,
                       advice);
  }
  // Hz; GoPro's gyros have 180 to 3200.
  const double rate = 1 / sampleClock(gyro, std::nullopt).slope;
  if (rate < 100 || rate > 6400) {
    return fmt::format("the IMU is left out: on the video's clock its gyro has {:.3g} Hz{}", rate, advice);
  }
  return std::nullopt;
}

std::vector<ImuSample> mergeAtGyroTimes(const GoproStreams& streams) {
  std::vector<ImuSample> samples;
  samples.reserve(streams.gyro.size());
  for (const TimedVector& gyro : streams.gyro) {
    ImuSample sample;
    sample.time = ImuTime(fromSeconds(gyro.t_s));
    sample.gyro = gyro.value;
    const auto after = std::lower_bound(streams.accel.begin(), streams.accel.end(), gyro.t_s,
                                        [](const TimedVector& accel, double t_s) { return accel.t_s < t_s; });
    if (after == streams.accel.begin()) {
      sample.accel = streams.accel.front().value;
    } else if (after == streams.accel.end()) {
      sample.accel = streams.accel.back().value;
    } else {
      const TimedVector& before = *std::prev(after);
      const double fraction = (gyro.t_s - before.t_s) / (after->t_s - before.t_s);
      sample.accel = (1 - fraction) * before.value + fraction * after->value;
    }
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace redbee
