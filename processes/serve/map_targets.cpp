#include "processes/serve/map_targets.hpp"

#include "processes/geolocation/view_fault_words.hpp"

namespace redbee {

void MapTargets::take(const targets_t& message, const LocalFrame& frame,
                      const std::optional<Eigen::Vector2d>& own) {
  // A geolocation that was restarted may count from another place.
  const bool is_restarted =
      message_ && (message.sequence < message_->sequence || message.has_global != message_->has_global);
  if (is_restarted) offset_.reset();
  if (!offset_) is_offset_global_ = false;
  message_ = message;
  if (message.has_global == 0 && !frame.isGlobal()) {
    offset_ = Eigen::Vector2d::Zero();  // both count from the estimator's origin
    return;
  }
  if (message.has_global != 0 && message.n > 0 && frame.isGlobal()) {
    const target_t& first = message.targets.front();
    offset_ = frame.positionOf({first.latitude, first.longitude}) -
              Eigen::Vector2d(first.position[0], first.position[1]);
    is_offset_global_ = true;
  } else if (message.has_view != 0 && own && !is_offset_global_) {
    // To the arm between camera and autopilot, which is less than is known of either place.
    offset_ = *own - Eigen::Vector2d(message.camera_position[0], message.camera_position[1]);
  }
}

Eigen::Vector2d MapTargets::onMap(const double* east_north) const {
  return Eigen::Vector2d(east_north[0], east_north[1]) + offset_.value_or(Eigen::Vector2d::Zero());
}

std::vector<MapTarget> MapTargets::targets() const {
  std::vector<MapTarget> result;
  result.reserve(message_->targets.size());
  for (const target_t& m : message_->targets) {
    MapTarget target;
    target.id = m.id;
    target.state = m.state;
    target.position = onMap(m.position);
    target.velocity = {m.velocity[0], m.velocity[1]};
    target.covariance << m.position_covariance[0], m.position_covariance[1], m.position_covariance[2],
        m.position_covariance[3];
    target.size = {m.size[0], m.size[1]};
    target.unseen_s = m.unseen;
    if (message_->has_global != 0) target.place = Geodetic{m.latitude, m.longitude};
    result.push_back(target);
  }
  return result;
}

std::optional<MapCamera> MapTargets::camera() const {
  if (message_->has_view == 0) return std::nullopt;
  MapCamera camera;
  camera.position = onMap(message_->camera_position);
  camera.height_m = message_->camera_height;
  camera.axis = Eigen::Map<const Eigen::Vector3d>(message_->camera_axis);
  if (message_->has_footprint != 0) {
    for (int corner = 0; corner < 4; ++corner)
      camera.footprint.push_back(onMap(message_->footprint + 2 * corner));
  }
  return camera;
}

std::string wordsOfTargetStatus(int8_t status, const Channels& channels) {
  switch (status) {
    case targets_t::GOOD:
    case targets_t::STALE_POSE:
    case targets_t::NO_POSITION:
    case targets_t::NO_MOUNT:
    case targets_t::NO_HEIGHT:
      return wordsOf(static_cast<ViewFault>(status), channels);
    case targets_t::NO_POSE:
      return wordsOf(ViewFault::kNoPose, channels) + " has come to redbee-geolocation";
    case targets_t::OTHER_CAMERA:
      return channels.detections + " are of another camera than the vehicle file's";
    default:
      return channels.targets + " has a status that is not known";
  }
}

}  // namespace redbee
