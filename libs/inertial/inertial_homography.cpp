#include "redbee/inertial/inertial_homography.hpp"

namespace redbee {

const char* toString(InertialStatus status) {
  switch (status) {
    case InertialStatus::kGood:
      return "good";
    case InertialStatus::kInitialising:
      return "initialising";
    case InertialStatus::kImuGap:
      return "IMU gap";
    case InertialStatus::kNoImu:
      return "no IMU";
    case InertialStatus::kClockJump:
      return "clock jump";
    case InertialStatus::kBadSamples:
      return "implausible IMU samples refused";
    case InertialStatus::kDisagreement:
      return "IMU and camera disagree";
    case InertialStatus::kNoMount:
      return "no attitude of the gimbal near the frame";
    case InertialStatus::kUncertain:
      return "the motion by the IMU is too uncertain";
  }
  return "unknown";
}

}  // namespace redbee
