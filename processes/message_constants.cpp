// The libraries do not depend on message types, so their enums and the messages' constants are compared here.
#include <cstdint>

#include "redbee/detection/detector.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/fusion/fused_homography.hpp"
#include "redbee/geolocation/geolocator.hpp"
#include "redbee/geolocation/view_estimator.hpp"
#include "redbee/inertial/inertial_homography.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/targets_t.hpp"
#include "redbee/visual/visual_homography.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee {
namespace {

template <typename State>
constexpr bool is(State state, int8_t constant) {
  return static_cast<int8_t>(state) == constant;
}

static_assert(is(InertialStatus::kGood, inertial_homography_t::GOOD));
static_assert(is(InertialStatus::kInitialising, inertial_homography_t::INITIALISING));
static_assert(is(InertialStatus::kImuGap, inertial_homography_t::IMU_GAP_BRIDGED));
static_assert(is(InertialStatus::kNoImu, inertial_homography_t::NO_IMU));
static_assert(is(InertialStatus::kClockJump, inertial_homography_t::CLOCK_JUMP));
static_assert(is(InertialStatus::kBadSamples, inertial_homography_t::IMPLAUSIBLE_SAMPLES));
static_assert(is(InertialStatus::kDisagreement, inertial_homography_t::VISION_DISAGREES));
static_assert(is(InertialStatus::kNoMount, inertial_homography_t::NO_GIMBAL));
static_assert(is(InertialStatus::kUncertain, inertial_homography_t::UNCERTAIN));

static_assert(is(VisualStatus::kGood, visual_homography_t::GOOD));
static_assert(is(VisualStatus::kFirstFrame, visual_homography_t::FIRST_FRAME));
static_assert(is(VisualStatus::kNoTexture, visual_homography_t::NO_TEXTURE));
static_assert(is(VisualStatus::kNoPlane, visual_homography_t::NO_PLANE));
static_assert(is(VisualStatus::kRepeated, visual_homography_t::REPEATED));

static_assert(is(FusionSource::kNone, fused_homography_t::NONE));
static_assert(is(FusionSource::kInertial, fused_homography_t::INERTIAL));
static_assert(is(FusionSource::kVisual, fused_homography_t::VISUAL));
static_assert(is(FusionSource::kFused, fused_homography_t::FUSED));

static_assert(is(DetectorStatus::kGood, foreground_t::GOOD));
static_assert(is(DetectorStatus::kLearning, foreground_t::LEARNING));
static_assert(is(DetectorStatus::kNoHomography, foreground_t::NO_HOMOGRAPHY));
static_assert(is(DetectorStatus::kBadImage, foreground_t::BAD_IMAGE));

static_assert(is(TargetState::kMoving, target_t::MOVING));
static_assert(is(TargetState::kStopped, target_t::STOPPED));
static_assert(is(TargetState::kCoasting, target_t::COASTING));

static_assert(is(ViewFault::kNone, targets_t::GOOD));
static_assert(is(ViewFault::kNoPose, targets_t::NO_POSE));
static_assert(is(ViewFault::kStalePose, targets_t::STALE_POSE));
static_assert(is(ViewFault::kNoPosition, targets_t::NO_POSITION));
static_assert(is(ViewFault::kNoMount, targets_t::NO_MOUNT));
static_assert(is(ViewFault::kNoHeight, targets_t::NO_HEIGHT));

}  // namespace
}  // namespace redbee
