#include "processes/redbee/vehicle/live_check.hpp"

#include "processes/conversions.hpp"
#include "processes/redbee/vehicle/live_findings.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/image_t.hpp"
#include "redbee/inertial/homography_measurement.hpp"
#include "redbee/inertial/rotation_difference.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/pose_t.hpp"

namespace redbee {
namespace {

constexpr size_t kKeptFrames = 64;
constexpr int kQueue = 4000;
/// rad: of the ground's normal in the camera, of which the rotation hardly depends.
constexpr double kNormalSigma = 0.02;

}  // namespace

LiveCheck::LiveCheck(Bus& bus, const Configuration& configuration)
    : configuration_(configuration),
      camera_(configuration.camera),
      timeshift_(configuration.inertial.extrinsics) {
  const Channels& channels = configuration_.channels;
  const auto nothing = [](const auto&) {};
  const auto listen = [&](const std::string& channel, auto message, auto handler) {
    using Message = decltype(message);
    subscriptions_.push_back(
        bus.subscribe(channel, kQueue, [this, channel, handler](const uint8_t* data, int size) {
          Message received;
          ++heard_;
          if (!decodeMessage(data, size, received) || !isPlausible(received)) {
            ++damaged_[channel];
            return;
          }
          stamps_[channel].note(received.utime, size);
          handler(received);
        }));
  };
  listen(channels.camera, image_t{}, [this](const image_t& m) { images_.note(m); });
  listen(channels.imu, ins_t{}, [this](const ins_t& m) { onImu(m); });
  listen(channels.altimeter, altimeter_t{}, nothing);
  listen(channels.pose, pose_t{}, nothing);
  listen(channels.health, process_health_t{}, [this](const process_health_t& m) { health_[m.process] = m; });
  listen(channels.inertial_homography, inertial_homography_t{}, [this](const inertial_homography_t& m) {
    inertial_[m.utime] = m;
    if (inertial_.size() > kKeptFrames) inertial_.erase(inertial_.begin());
  });
  listen(channels.fused_homography, fused_homography_t{},
         [this](const fused_homography_t& m) { onFused(m); });
}

void LiveCheck::onImu(const ins_t& message) {
  const ImuSample sample{ImuTime(fromUtime(message.utime)), vector3(message.gyro), vector3(message.accel)};
  if (!configuration_.inertial.gimbal.enabled)
    timeshift_.addGyro(sample.time, configuration_.inertial.gyro_correction * sample.gyro);
  if (imu_.empty() || sample.time > imu_.back().time) imu_.push_back(sample);
}

void LiveCheck::onFused(const fused_homography_t& message) {
  const auto inertial = inertial_.find(message.utime);
  if (inertial == inertial_.end() || inertial->second.valid == 0 || message.has_observation == 0) return;
  if (inertial->second.utime_previous != message.utime_previous) return;
  compareRotations(inertial->second, message);
}

/// As the inertial filter compares them (inertial/vision_comparison.hpp), by the messages.
void LiveCheck::compareRotations(const inertial_homography_t& inertial, const fused_homography_t& fused) {
  const PlaneMotion motion = motionOf(inertial.motion);
  const ImageScaling scaling(camera_.ideal().width, camera_.ideal().height);
  const Eigen::Matrix3d normal = kNormalSigma * kNormalSigma * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d K_now = zoomed(camera_.K(), zoomOf(inertial));
  // The frame before is that of the message's earlier step.
  const bool is_next = inertial.earlier.valid != 0 && inertial.earlier.utime == inertial.utime_previous;
  const Eigen::Matrix3d K_before = is_next ? zoomed(camera_.K(), zoomOf(inertial.earlier)) : K_now;
  const CameraPair cameras{scaling.T * K_before, scaling.T * K_now};
  const auto difference = rotationDifference(cameras, motion, matrix3(inertial.rotation_covariance), normal,
                                             toVector(scaling.scale(matrix3(fused.observed.H))),
                                             matrix8(fused.observed.covariance));
  if (!difference) return;
  timeshift_.addVision(previousTimeOf(fused), timeOf(fused), expSO3(difference->difference) * motion.R_ba);
}

int64_t LiveCheck::bytes() const {
  int64_t sum = 0;
  for (const auto& [channel, stamps] : stamps_) sum += stamps.bytes();
  return sum;
}

std::vector<Finding> LiveCheck::findings() const {
  const Channels& channels = configuration_.channels;
  const auto stream = [&](const std::string& channel, const StreamLimits& limits) {
    const auto stamps = stamps_.find(channel);
    const auto damaged = damaged_.find(channel);
    return findStream(channel, stamps == stamps_.end() ? StampStatistics() : stamps->second,
                      damaged == damaged_.end() ? 0 : damaged->second, limits);
  };
  std::vector<Finding> found;
  found.push_back(stream(channels.camera, cameraLimits(configuration_)));
  if (configuration_.has_imu) found.push_back(stream(channels.imu, imuLimits(configuration_)));
  if (configuration_.has_altimeter)
    found.push_back(stream(channels.altimeter, altimeterLimits(configuration_)));
  if (stamps_.count(channels.pose) > 0 || wantsPose(configuration_)) {
    found.push_back(stream(channels.pose, poseLimits(configuration_)));
  }
  found.push_back(findExposure(images_, configuration_));
  found.push_back(findSharpness(images_, configuration_));
  if (configuration_.has_imu) {
    found.push_back(findTimeshift(timeshift_, configuration_));
    found.push_back(findImuNoise(restNoise(imu_, configuration_.inertial.noise), configuration_));
  }
  for (const auto& [name, health] : health_) found.push_back(findHealth(health));
  if (health_.empty())
    found.push_back({false, "processes: none is heard", "start the stack: scripts/fly up --config FILE"});
  return found;
}

}  // namespace redbee
