#include "redbee/importers/imu_check.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "redbee/importers/import.hpp"
#include "redbee/importers/impossible_values.hpp"
#include "redbee/importers/time_check.hpp"
#include "redbee/importers/unit_check.hpp"

namespace redbee {
namespace {

// Hz. No IMU that helps between two frames is slower or faster than these.
constexpr double kLeastRate = 20;
constexpr double kUsefulRate = 90;
constexpr double kMostRate = 20000;
/// Fewer samples than this show nothing.
constexpr size_t kFewSamples = 10;

/// More of them than can be left out.
void checkPossible(const std::vector<ImuSample>& imu, ImuFindings& findings) {
  const auto wrong =
      std::count_if(imu.begin(), imu.end(), [](const ImuSample& sample) { return !isPossible(sample); });
  if (wrong == 0) return;
  findings.faults.push_back(
      fmt::format("{} of {} IMU samples are beyond what any measures, in no known unit: the recording is "
                  "damaged; import without the IMU",
                  wrong, imu.size()));
}

void checkRate(const std::vector<ImuSample>& imu, double frames_s, const ImuUnits& read_as,
               ImuFindings& findings) {
  const double rate = 1 / medianPeriod_s(imu);
  const double span_s = seconds(imu.back().time - imu.front().time);
  if (rate >= kLeastRate && rate <= kMostRate) {
    if (rate < kUsefulRate)
      findings.warnings.push_back(
          fmt::format("the IMU has {:.3g} Hz, which is slow: 100 Hz or more are needed to "
                      "follow a drone between frames",
                      rate));
    return;
  }
  const auto off = [&](double span) { return std::abs(std::log(span / std::max(frames_s, 0.1))); };
  const std::string unit = firstUnit(timeUnits(), read_as.time, "--time-unit", [&](double factor) {
    const double other = rate / factor;
    return other >= kLeastRate && other <= kMostRate && off(span_s * factor) < off(span_s);
  });
  const std::string what =
      fmt::format("the IMU has {:.3g} Hz over {:.3g} s, the video lasts {:.3g} s", rate, span_s, frames_s);
  if (unit.empty()) {
    findings.warnings.push_back(what + ": 100 Hz or more are needed to follow a drone between frames");
  } else {
    findings.faults.push_back(what + ": its times fit " + unit + ", give --time-unit " + unit);
  }
}

void checkHoles(const std::vector<ImuSample>& imu, ImuFindings& findings) {
  // A sample or two may be lost; an interpolation over more misses a manoeuvre.
  const double tolerated_s = std::max(5 * medianPeriod_s(imu), 0.02);
  double longest_s = 0, at_s = 0;
  int count = 0;
  for (size_t i = 1; i < imu.size(); ++i) {
    const double hole_s = seconds(imu[i].time - imu[i - 1].time);
    if (hole_s <= tolerated_s) continue;
    ++count;
    if (hole_s <= longest_s) continue;
    longest_s = hole_s;
    at_s = seconds(imu[i - 1].time.time_since_epoch());
  }
  if (count == 0) return;
  if (longest_s > kClockWasSet_s) {
    findings.faults.push_back(
        fmt::format("the IMU's times leap by {:.0f} s after {:.3f} s: take out what leaps, or "
                    "cut the recording there",
                    longest_s, at_s));
    return;
  }
  findings.warnings.push_back(
      fmt::format("the IMU has {} hole{}, the longest of {:.3g} s at {:.3f} s: record it "
                  "with a larger buffer",
                  count, count == 1 ? "" : "s", longest_s, at_s));
}

void checkConstants(const std::vector<ImuSample>& imu, ImuFindings& findings) {
  const char* names[2][3] = {{"gx", "gy", "gz"}, {"ax", "ay", "az"}};
  std::string constant;
  for (int sensor = 0; sensor < 2; ++sensor) {
    const auto values = [sensor](const ImuSample& sample) {
      return sensor == 0 ? sample.gyro : sample.accel;
    };
    for (int axis = 0; axis < 3; ++axis) {
      const double first = values(imu.front())[axis];
      const bool same = std::all_of(imu.begin(), imu.end(),
                                    [&](const ImuSample& sample) { return values(sample)[axis] == first; });
      if (same)
        constant += fmt::format("{}{} = {:g}", constant.empty() ? "" : ", ", names[sensor][axis], first);
    }
  }
  if (constant.empty()) return;
  findings.warnings.push_back(
      "the IMU never changes: " + constant +
      "; a sensor that is alive has noise: check the columns, or import without the IMU");
}

}  // namespace

ImuFindings checkImu(const std::vector<ImuSample>& imu, CameraTime first_frame, CameraTime last_frame,
                     const ImuUnits& read_as) {
  ImuFindings findings;
  if (imu.empty()) return findings;
  if (imu.size() < kFewSamples) {
    findings.warnings.push_back(
        fmt::format("the IMU has {} sample{}, too few to be checked or flown with: import without the IMU",
                    imu.size(), imu.size() == 1 ? "" : "s"));
  } else {
    checkRate(imu, seconds(last_frame - first_frame), read_as, findings);
    checkGravity(imu, read_as, findings);
    // In a wrong unit of time the gyro's turns mean nothing.
    if (findings.faults.empty()) checkTurns(imu, read_as, findings);
    if (findings.faults.empty()) checkPossible(imu, findings);
    checkHoles(imu, findings);
    checkConstants(imu, findings);
  }
  const auto coverage = imuCoverageWarning(imu, first_frame, last_frame);
  if (!coverage) return findings;
  const bool covers_none =
      imu.front().time > toImu(last_frame, Duration(0)) || imu.back().time < toImu(first_frame, Duration(0));
  if (covers_none && imu.size() >= kFewSamples) {
    findings.faults.push_back(*coverage +
                              ": they must count on one clock, such as from the video's first frame");
  } else {
    findings.warnings.push_back(*coverage);
  }
  return findings;
}

}  // namespace redbee
