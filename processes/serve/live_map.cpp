#include "processes/serve/live_map.hpp"

#include <nlohmann/json.hpp>

#include "processes/serve/frame_view.hpp"
#include "processes/serve/map_json.hpp"

namespace redbee {
namespace {

constexpr std::chrono::seconds kFrameIsCurrent{1};  ///< without images, POSE says what time it is

}  // namespace

LiveMap::LiveMap(const Configuration& configuration)
    : map_(configuration),
      expects_targets_(configuration.geolocation.enabled),
      targets_channel_(configuration.channels.targets),
      timeshift_us_(fromSeconds(configuration.inertial.extrinsics.timeshift_s).count()) {}

void LiveMap::onPose(const pose_t& pose) {
  map_.onPose(pose);
  pose_utime_ = pose.utime;
  is_new_ = true;
}

void LiveMap::onTargets(const targets_t& targets) {
  map_.onTargets(targets);
  is_new_ = true;
}

void LiveMap::onFrame(int64_t utime, Time now) {
  frame_utime_ = utime;
  frame_arrival_ = now;
  is_new_ = true;
}

void LiveMap::renew() {
  is_new_ = true;
  next_ = Time();
}

int64_t LiveMap::utimeAt(Time now) const {
  const bool is_frame_current = frame_utime_ != 0 && now - frame_arrival_ < kFrameIsCurrent;
  return is_frame_current || pose_utime_ == 0 ? frame_utime_ : pose_utime_ - timeshift_us_;
}

std::optional<std::string> LiveMap::takeText(Time now) {
  if (!is_new_ || now < next_) return std::nullopt;
  is_new_ = false;
  next_ = now + kPeriod;
  MapView view = map_.view(utimeAt(now));
  if (expects_targets_ && !map_.hasTargets() && view.note.empty())
    view.note = "no " + targets_channel_ + ": redbee-geolocation does not answer";
  return textOf(mapJson(view));
}

}  // namespace redbee
