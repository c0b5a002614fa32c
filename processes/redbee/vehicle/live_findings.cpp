#include "processes/redbee/vehicle/live_findings.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "processes/camera/image_watch.hpp"
#include "processes/redbee/vehicle/record.hpp"
#include "redbee/geometry/angle.hpp"
#include "redbee/node/health.hpp"

namespace redbee {
namespace {

constexpr double kMilli = 1e3;
constexpr double kMega = 1e6;
/// Of the image. No source: beyond it what moves there is lost, whatever the rest shows.
constexpr double kMostSaturated = 0.05;
/// Of the configured density. No source: the filter's covariances are off by its square.
constexpr double kMostNoise = 2;

/// Jitter of the stamps moves the time shift, of which this much is tolerated.
double stampTolerance() { return TimeshiftMonitor::Parameters().tolerance_s; }

}  // namespace

StreamLimits cameraLimits(const Configuration& configuration) {
  return {configuration.capture.rate_hz,
          "capture.rate_hz",
          configuration.visual.max_frame_gap_s,
          "visual.max_frame_gap_s",
          stampTolerance(),
          "the camera (redbee-camera, or a driver of your own)"};
}

StreamLimits imuLimits(const Configuration& configuration) {
  const bool asks = !configuration.autopilot.link.empty();
  return {asks ? configuration.autopilot.imu_rate_hz : 0,
          "autopilot.imu_rate_hz",
          configuration.inertial.max_imu_gap_s,
          "inertial.max_imu_gap_s",
          stampTolerance(),
          "the IMU (redbee-autopilot, or a driver of your own)"};
}

StreamLimits altimeterLimits(const Configuration& configuration) {
  const bool asks = !configuration.autopilot.link.empty();
  return {asks ? configuration.autopilot.position_rate_hz : 0, "autopilot.position_rate_hz", 0, "", 0,
          "the altimeter, or set altimeter.present: false"};
}

StreamLimits poseLimits(const Configuration& configuration) {
  const bool asks = !configuration.autopilot.link.empty();
  const bool is_used = configuration.geolocation.enabled;
  return {asks ? configuration.autopilot.attitude_rate_hz : 0,
          "autopilot.attitude_rate_hz",
          is_used ? configuration.geolocation.max_pose_age_s : 0,
          "geolocation.max_pose_age_s",
          0,
          "the autopilot (redbee-autopilot)"};
}

bool wantsPose(const Configuration& configuration) {
  return configuration.geolocation.enabled || !configuration.autopilot.link.empty();
}

Finding findStream(const std::string& channel, const StampStatistics& stamps, int64_t damaged,
                   const StreamLimits& limits) {
  if (stamps.count() < 3) {
    return {false, fmt::format("{}: {} messages, {} damaged", channel, stamps.count(), damaged),
            "start what publishes it: " + limits.source};
  }
  const StampStatistics::Summary s = stamps.summary();
  const std::string what = fmt::format(
      "{}: {:.1f} Hz, jitter {:.1f} ms, longest gap {:.0f} ms, {} missing of {}", channel, s.rate_hz,
      kMilli * s.jitter_s, kMilli * s.longest_gap_s, s.holes, stamps.count() + s.holes);
  if (damaged > 0)
    return {false, what + fmt::format(", {} damaged", damaged), "another program publishes on this channel?"};
  if (s.backwards > 0) {
    return {false, what + fmt::format(", {} times not after the one before", s.backwards),
            "one source on each channel, and stamps of a clock that is never set (CLOCK_MONOTONIC)"};
  }
  if (limits.rate_hz > 0 && s.rate_hz < ImageWatch::kSlowBelow * limits.rate_hz) {
    return {false, what + fmt::format("; {} is {:.0f}", limits.rate_key, limits.rate_hz),
            "raise the rate at " + limits.source + ", free the link or the processor, or correct " +
                limits.rate_key};
  }
  if (limits.max_gap_s > 0 && s.longest_gap_s > limits.max_gap_s) {
    return {false, what + fmt::format("; {} is {:.0f} ms", limits.gap_key, kMilli * limits.max_gap_s),
            "look for lost messages: receive buffer, link, processor (redbee top)"};
  }
  if (limits.max_jitter_s > 0 && s.jitter_s > limits.max_jitter_s) {
    return {false, what + fmt::format("; tolerated are {:.0f} ms", kMilli * limits.max_jitter_s),
            "stamp at the exposure, not at the arrival: a driver's own times, PPS or a trigger "
            "(config/README.md)"};
  }
  return {true, what, ""};
}

Finding findExposure(const ImageQuality& images, const Configuration& configuration) {
  if (images.looked() == 0) {
    if (images.damaged() == 0) return {false, "exposure: no images", "see the channel of the camera"};
    return {false, "exposure: no image could be decoded", "publish JPEG, or raw grey, RGB or BGR"};
  }
  const std::string what = fmt::format(
      "exposure: median {:.0f} of 255, contrast {:.0f}, {:.1f} % saturated, {:.1f} % black",
      images.greyMedian(), images.contrast(), 100 * images.saturatedFraction(), 100 * images.darkFraction());
  if (images.greyMedian() <= ImageQuality::kDark)
    return {false, what + ": too dark", "open the lens or lengthen the exposure"};
  if (images.greyMedian() >= ImageQuality::kBright || images.saturatedFraction() > kMostSaturated) {
    return {false, what + ": too bright", "shorten the exposure, or leave the sky out of the image"};
  }
  if (images.contrast() < configuration.detection.min_contrast) {
    return {false, what + fmt::format("; detection.min_contrast is {}", configuration.detection.min_contrast),
            "is the lens covered or fogged?"};
  }
  return {true, what, ""};
}

Finding findSharpness(const ImageQuality& images, const Configuration& configuration) {
  if (images.looked() == 0) return {false, "sharpness: no images", "see the channel of the camera"};
  const VisualParameters& visual = configuration.visual;
  const bool has_own = visual.min_sharpness > visual.tracker.min_eigenvalue;
  const double least = has_own ? visual.min_sharpness : visual.tracker.min_eigenvalue;
  const std::string what =
      fmt::format("sharpness: {:.1f} grey levels^2; {} is {}", images.sharpness(),
                  has_own ? "visual.min_sharpness" : "visual.tracker.min_eigenvalue", least);
  if (images.sharpness() >= least) return {true, what, ""};
  return {false, what, "focus the lens, shorten the exposure, or look at ground with texture"};
}

Finding findTimeshift(const TimeshiftMonitor& timeshift, const Configuration& configuration) {
  const auto& fit = timeshift.estimate();
  if (!fit) {
    return {true,
            fmt::format("time shift: not shown by rotations of {:.1f} deg/s", timeshift.rotation_deg_s()),
            "turn the vehicle by 10 degrees about each axis, to and fro, over textured ground, while this "
            "listens "
            "(--seconds 15)",
            false};
  }
  const double tolerance_s = TimeshiftMonitor::Parameters().tolerance_s;
  const double configured_s = configuration.inertial.extrinsics.timeshift_s;
  const std::string what = fmt::format(
      "time shift: {:+.1f} ms beyond camera.timeshift_s, sigma {:.1f} ms; tolerated are {:.0f} ms",
      kMilli * fit->shift_s, kMilli * fit->sigma_s, kMilli * tolerance_s);
  if (std::abs(fit->shift_s) <= tolerance_s) return {true, what, ""};
  return {false, what,
          fmt::format("set camera.timeshift_s: {:.4f}, or calibrate", configured_s + fit->shift_s)};
}

Finding findImuNoise(const RestReport& rest, const Configuration& configuration) {
  if (rest.status == RestStatus::kTooShort) {
    return {true, "IMU noise: too few samples", "listen for longer (--seconds 10)", false};
  }
  if (!rest.noise) {
    return {true, fmt::format("IMU noise: the vehicle moves ({:.2f} deg/s)", rest.turning / kDegree),
            "leave it at rest, with the motors off, while this listens", false};
  }
  const ImuNoise& configured = configuration.inertial.noise;
  const std::string what = fmt::format(
      "IMU noise at rest for {:.0f} s: gyro {:.2g} rad/s/sqrt(Hz), configured {:.2g}; accelerometer {:.2g} "
      "m/s^2/sqrt(Hz), configured {:.2g}",
      rest.noise->seconds, rest.noise->gyro_density, configured.gyro_noise_density, rest.noise->accel_density,
      configured.accel_noise_density);
  std::string fix;
  const auto compare = [&](double measured, double expected, const char* key) {
    if (measured <= kMostNoise * expected) return;
    fix += fmt::format("{}set {}: {:.2g}", fix.empty() ? "" : ", ", key, measured);
  };
  compare(rest.noise->gyro_density, configured.gyro_noise_density, "imu.gyro_noise_density");
  compare(rest.noise->accel_density, configured.accel_noise_density, "imu.accel_noise_density");
  return {fix.empty(), what, fix.empty() ? "" : fix + ", or damp the IMU against vibration"};
}

Finding findHealth(const process_health_t& health) {
  const auto state = static_cast<HealthState>(health.state);
  const std::string what =
      health.process + ": " + toString(state) + (health.message.empty() ? "" : ", " + health.message);
  if (state == HealthState::kGood) return {true, what, ""};
  return {false, what, "redbee top; scripts/fly logs NAME"};
}

Finding findDisk(const std::filesystem::path& folder, double bytes_per_s) {
  std::error_code error;
  std::filesystem::path existing = folder;
  while (!existing.empty() && !std::filesystem::exists(existing, error)) existing = existing.parent_path();
  const auto space = std::filesystem::space(existing.empty() ? "." : existing, error);
  if (error)
    return {false, fmt::format("disk: {}: {}", folder.string(), error.message()), "give --recordings DIR"};
  const double least_mb = RecordOptions().min_free_mb;
  const double free_mb = static_cast<double>(space.available) / kMega;
  const double lasts_min = (free_mb - least_mb) * kMega / (60 * bytes_per_s);
  std::string what = fmt::format("disk: {}: {:.0f} MB free", folder.string(), free_mb);
  if (free_mb <= least_mb) {
    return {false, what + fmt::format(", {:.0f} MB are kept free by the recorder", least_mb),
            "delete old recordings, or give --recordings DIR"};
  }
  if (bytes_per_s > 0)
    what += fmt::format(", a recording lasts {:.0f} min at {:.1f} MB/s", lasts_min, bytes_per_s / kMega);
  return {true, what, ""};
}

}  // namespace redbee
