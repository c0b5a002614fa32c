#include "redbee/detection/held_frames.hpp"

#include "redbee/geometry/compose_motion.hpp"
#include "redbee/imaging/repeated_image.hpp"

namespace redbee {
void HeldFrames::begin(const DetectorOutput& output) {
  output_ = output;
  since_.reset();
}

bool HeldFrames::covers(CameraTime time) const { return output_ && time - output_->time <= kMaxRepetition; }

DetectorOutput HeldFrames::hold(const FrameInput& repeated) {
  const FrameInput whole = sinceImage(repeated);
  since_ = Motion{*whole.ground, whole.front, whole.motion, whole.K_previous};
  DetectorOutput held = *output_;
  held.time = repeated.time;
  return held;
}

FrameInput HeldFrames::sinceImage(FrameInput next) const {
  if (!since_ || !next.ground) return next;
  next.ground = composeHomographies(next.ground, since_->ground);
  next.front = composeHomographies(next.front, since_->front);
  next.motion = compose(next.motion, since_->motion);
  next.K_previous = since_->K_previous;
  return next;
}

}  // namespace redbee
