#include "processes/redbee/export/camera_infos.hpp"

#include <utility>

#include "processes/lens_messages.hpp"
#include "redbee/geometry/camera.hpp"

namespace redbee {
namespace {

constexpr int64_t kLongestWait_us = 1'000'000;

}  // namespace

CameraInfos::CameraInfos(const Configuration& configuration, Write write)
    : configuration_(configuration), write_(std::move(write)) {
  const InertialParameters& inertial = configuration.inertial;
  if (inertial.lens.enabled) lens_.emplace(inertial.lens, fromSeconds(inertial.extrinsics.timeshift_s));
}

void CameraInfos::add(const std::string& topic, const image_t& image) {
  const CameraIntrinsics& camera = configuration_.camera;
  if (image.width != camera.width || image.height != camera.height) return;
  pending_.push_back({topic, image.utime});
  while (!pending_.empty() && isDue(pending_.front().utime)) writeFront();
}

void CameraInfos::add(const lens_t& message) {
  const auto sample = lens_ ? lensSampleOf(message, configuration_) : std::nullopt;
  if (sample) lens_->add(*sample);
}

void CameraInfos::finish() {
  while (!pending_.empty()) writeFront();
}

ImuTime CameraInfos::imuTimeOf(int64_t utime) const {
  return toImu(CameraTime(fromUtime(utime)), fromSeconds(configuration_.inertial.extrinsics.timeshift_s));
}

bool CameraInfos::isDue(int64_t utime) const {
  return !lens_ || lens_->reaches(imuTimeOf(utime)) || pending_.back().utime - utime >= kLongestWait_us ||
         pending_.back().utime < utime;
}

void CameraInfos::writeFront() {
  const Pending front = pending_.front();
  pending_.pop_front();
  if (!lens_) return write_(front.topic, front.utime, configuration_.camera);
  const ImuTime time = imuTimeOf(front.utime);
  write_(front.topic, front.utime, zoomed(configuration_.camera, lens_->at(time).value));
  lens_->eraseBefore(time - fromUtime(kLongestWait_us));
}

}  // namespace redbee
