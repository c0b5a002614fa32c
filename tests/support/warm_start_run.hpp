// A flight through inertial process and fusion, in which the inertial process is killed and restarted. Vision
// is simulated without images, so that long flights are fast.
#pragma once

#include <algorithm>
#include <cstdio>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "processes/conversions.hpp"
#include "processes/homography_fusion/node.hpp"
#include "processes/imu_integration/node.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/filter_snapshot_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/visual_homography_t.hpp"
#include "tests/support/consumer_imu.hpp"
#include "tests/support/log_capture.hpp"
#include "tests/support/noisy_homography.hpp"
#include "tests/support/sensor_messages.hpp"
#include "tests/support/simulated_flight.hpp"

namespace redbee::test {

inline constexpr int kFrames = 324;
inline constexpr int kKilledAt = 240;  ///< the height has been learned after ten seconds
inline constexpr int kDownFrames = 8;  ///< a third of a second: what supervisor needs
inline constexpr int kBackAt = kKilledAt + kDownFrames;

/// A drone with an error of 40 % in its configured height, and a matching sigma.
struct WarmStartFlight : SimulatedFlight {
  explicit WarmStartFlight(unsigned seed, bool with_altimeter = false) : SimulatedFlight(seed, 8) {
    ConsumerImu parameters(seed);
    parameters.gyro_bias = {0.004, -0.006, 0.003};
    parameters.accel_bias = {0.06, 0.05, -0.06};
    const double end = kFrames / kFrameRate + 0.5;
    samples = imu(parameters, end);
    if (with_altimeter) altitudes = altimeter(0, end, seed);
    configuration.camera = intrinsics();
    configuration.has_altimeter = with_altimeter;
    configuration.inertial.extrinsics = extrinsics;
    configuration.inertial.noise = consumerNoise();
    configuration.inertial.extrinsics.start_height_m = 0.6 * trueHeight(0);
    configuration.inertial.extrinsics.start_height_sigma_m = 0.4 * trueHeight(0);
  }
  double trueHeight(int k) const { return heightAt(frameTime(k)); }
  /// From frame k-1 to frame k.
  Eigen::Matrix3d step(int k) const { return homography(frameTime(k - 1), frameTime(k)); }

  std::vector<ImuSample> samples;
  std::vector<AltitudeSample> altitudes;
  Configuration configuration;
};

struct FaultInjection {
  int restarted_at = kBackAt;                                ///< frame; below 0: the process is not killed
  bool drop_warm_start = false;                              ///< the restarted process receives no warm start
  std::function<void(filter_snapshot_t&)> corrupt_snapshot;  ///< of the last snapshot, before it is offered
  std::function<void(int, visual_homography_t&)> corrupt_vision;
  Duration feedback_delay{0};  ///< on the fused homographies' way to the inertial process
  double feedback_lost = 0;    ///< probability, on the same way
};

struct RunResult {
  std::map<int, inertial_homography_t> homographies;  ///< by frame
  std::vector<filter_snapshot_t> snapshots;
  int offers = 0;  ///< warm starts that were published
  std::string log;
};

class WarmStartRun {
 public:
  WarmStartRun(const WarmStartFlight& flight, FaultInjection faults)
      : flight_(flight), faults_(std::move(faults)) {
    subscriptions_.push_back(bus_->subscribe<inertial_homography_t>(
        "INERTIAL_HOMOGRAPHY", 64,
        [&](const inertial_homography_t& m) { result_.homographies[frameAt(m.utime)] = m; }));
    subscriptions_.push_back(bus_->subscribe<filter_snapshot_t>(
        "FILTER_SNAPSHOT", 64, [&](const filter_snapshot_t& m) { result_.snapshots.push_back(m); }));
    subscriptions_.push_back(bus_->subscribe<filter_snapshot_t>(
        "WARM_START", 64, [&](const filter_snapshot_t&) { ++result_.offers; }));
    subscriptions_.push_back(bus_->subscribe<fused_homography_t>(
        "FUSED_HOMOGRAPHY", 64, [&](const fused_homography_t& m) { feedBack(m); }));
  }

  RunResult run() {
    const LogCapture log;
    fusion_ = std::make_unique<HomographyFusionNode>(*bus_, flight_.configuration);
    start(flight_.configuration);
    for (; frame_ < kFrames; ++frame_) {
      if (frame_ == kKilledAt && faults_.restarted_at > 0) kill();
      if (frame_ == faults_.restarted_at) restart();
      publishFrame();
    }
    result_.log = log.text();
    return result_;
  }

 private:
  void start(const Configuration& configuration) {
    Configuration hears = configuration;
    if (isFeedbackDisturbed()) hears.channels.fused_homography = "FEEDBACK";
    inertial_ = std::make_unique<ImuIntegrationNode>(*bus_, hears);
  }
  void kill() { inertial_.reset(); }
  void restart() {
    Configuration configuration = flight_.configuration;
    if (faults_.drop_warm_start) configuration.channels.warm_start = "NOWHERE";
    start(configuration);
    if (!faults_.corrupt_snapshot) return;
    filter_snapshot_t snapshot = result_.snapshots.back();
    faults_.corrupt_snapshot(snapshot);
    bus_->publish("FILTER_SNAPSHOT", snapshot);
  }

  bool isFeedbackDisturbed() const { return faults_.feedback_delay.count() > 0 || faults_.feedback_lost > 0; }

  void feedBack(const fused_homography_t& m) {
    if (!isFeedbackDisturbed() || std::bernoulli_distribution(faults_.feedback_lost)(losses_)) return;
    late_.emplace_back(frameTime(frame_) + faults_.feedback_delay, m);
    deliverFeedback();
  }
  void deliverFeedback() {
    for (; !late_.empty() && late_.front().first <= frameTime(frame_); late_.pop_front()) {
      bus_->publish("FEEDBACK", late_.front().second);
    }
  }

  void publishFrame() {
    deliverFeedback();
    const CameraTime time = frameTime(frame_);
    const ImuTime altitudes_until = toImu(time, Duration(0));
    const ImuTime samples_until = toImu(time, std::chrono::milliseconds(15));
    const auto& samples = flight_.samples;
    for (; next_sample_ < samples.size() && samples[next_sample_].time <= samples_until; ++next_sample_) {
      bus_->publish("IMU", message(samples[next_sample_]));
    }
    const auto& altitudes = flight_.altitudes;
    for (; next_altitude_ < altitudes.size() && altitudes[next_altitude_].time <= altitudes_until;
         ++next_altitude_) {
      bus_->publish("ALTIMETER", message(altitudes[next_altitude_]));
    }
    image_t image{};
    image.utime = toUtime(time);
    image.width = kWidth;
    image.height = kHeight;
    bus_->publish("CAMERA", image);
    settle();
    bus_->publish("VISUAL_HOMOGRAPHY", vision());
    settle();
  }

  /// The frame of this time; it may be answered while a later one is being worked on.
  int frameAt(int64_t utime) const {
    int k = frame_;
    while (k > 0 && toUtime(frameTime(k)) > utime) --k;
    return k;
  }

  void settle() {
    do {
      if (inertial_) inertial_->process();
      fusion_->process();
    } while (bus_->handle(std::chrono::milliseconds(0)) > 0);
  }

  visual_homography_t vision() {
    constexpr double kNoise_px = 0.3;
    visual_homography_t vision{};
    vision.utime = toUtime(frameTime(frame_));
    vision.utime_previous = toUtime(frameTime(std::max(0, frame_ - 1)));
    vision.sequence = frame_;
    vision.status = frame_ > 0 ? 0 : 1;
    vision.width = kWidth;
    vision.height = kHeight;
    const HomographyObservation seen = noisyHomography(
        frame_ > 0 ? flight_.step(frame_) : Eigen::Matrix3d::Identity().eval(), kNoise_px, random_);
    fill(vision.ground, seen.H, seen.covariance);
    vision.inliers = 48;
    if (faults_.corrupt_vision) faults_.corrupt_vision(frame_, vision);
    return vision;
  }

  const WarmStartFlight& flight_;
  FaultInjection faults_;
  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  std::unique_ptr<HomographyFusionNode> fusion_;
  std::unique_ptr<ImuIntegrationNode> inertial_;
  std::mt19937 random_{7};
  std::mt19937 losses_{3};
  std::deque<std::pair<CameraTime, fused_homography_t>> late_;  ///< when it is due
  int frame_ = 0;
  size_t next_sample_ = 0;
  size_t next_altitude_ = 0;
  RunResult result_;
  std::vector<Subscription> subscriptions_;
};

inline RunResult run(const WarmStartFlight& flight, const FaultInjection& faults = {}) {
  return WarmStartRun(flight, faults).run();
}

struct Errors {
  double first_px = 0;   ///< of the first homography after the restart
  double second_px = 0;  ///< mean over the following second
  double height = 0;     ///< mean over the same, fraction of the true height
};

inline double error_px(const WarmStartFlight& flight, const RunResult& result, int k) {
  return meanTransferError(matrix3(result.homographies.at(k).ground.H), flight.step(k), kWidth, kHeight);
}

inline Errors errorsFrom(const WarmStartFlight& flight, const RunResult& result, int first) {
  Errors errors;
  errors.first_px = error_px(flight, result, first);
  for (int k = first + 1; k <= first + 24; ++k) {
    errors.second_px += error_px(flight, result, k) / 24;
    errors.height += std::abs(result.homographies.at(k).camera_height / flight.trueHeight(k) - 1) / 24;
  }
  return errors;
}

inline void print(const char* what, const Errors& e) {
  std::printf("%-16s first %.2f px, second after %.3f px, height %.1f %%\n", what, e.first_px, e.second_px,
              100 * e.height);
}

}  // namespace redbee::test
