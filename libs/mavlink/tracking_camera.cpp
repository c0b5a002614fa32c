#include "redbee/mavlink/tracking_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace redbee::mavlink {
namespace {

constexpr uint8_t kCameraType = 30;       // MAV_TYPE_CAMERA
constexpr uint8_t kNotAnAutopilot = 8;    // MAV_AUTOPILOT_INVALID
constexpr uint8_t kActiveState = 4;       // MAV_STATE_ACTIVE
constexpr double kPointTolerance = 0.02;  // of the image's width, beside a box: a finger on a small screen
constexpr double kShortestInterval_us = 20'000;
constexpr double kLongestInterval_us = 60e6;

double distanceOf(const RelativeBox& box, double x, double y) {
  return std::hypot(std::max({box.left - x, 0.0, x - box.right}),
                    std::max({box.top - y, 0.0, y - box.bottom}));
}
/// Intersection over union.
double overlapOf(const RelativeBox& a, const RelativeBox& b) {
  const double width = std::min(a.right, b.right) - std::max(a.left, b.left);
  const double height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  if (width <= 0 || height <= 0) return 0;
  return width * height / (a.area() + b.area() - width * height);
}
bool isRelative(float value) { return value >= 0 && value <= 1; }

int64_t periodOf(double rate_hz) { return static_cast<int64_t>(1e9 / rate_hz); }

}  // namespace

bool TrackingCamera::Stream::isDue(int64_t host_ns) {
  if (period_ns == 0 || host_ns < next_ns) return false;
  next_ns += period_ns;
  if (next_ns <= host_ns) next_ns = host_ns + period_ns;  // what was missed is not made up for
  return true;
}

TrackingCamera::TrackingCamera(const GroundLinkParameters& parameters, int width, int height,
                               const std::optional<SigningKey>& key, SigningTime now)
    : parameters_(parameters),
      width_(width),
      height_(height),
      encoder_(static_cast<uint8_t>(parameters.system_id), static_cast<uint8_t>(parameters.component_id)),
      trust_(key, now, encoder_),
      shown_ns_(std::numeric_limits<int64_t>::min() / 2) {
  image_.period_ns = geo_.period_ns = periodOf(parameters.rate_hz);
}

void TrackingCamera::receive(const uint8_t* data, size_t size, int64_t host_ns, bool is_datagram) {
  parser_.feed(data, size);
  if (is_datagram) parser_.endOfDatagram();
  while (const auto frame = parser_.next()) {
    loss_.note(*frame);
    const bool is_command = frame->id == CommandLong::kId || frame->id == CommandInt::kId;
    if (is_command && trust_.accepts(*frame, encoder_)) handle(*frame, host_ns);
  }
}

void TrackingCamera::reconnect() {
  parser_.endOfDatagram();
  while (parser_.next()) {
  }
}

void TrackingCamera::handle(const Frame& frame, int64_t host_ns) {
  const CommandLong command =
      frame.id == CommandInt::kId ? frame.message<CommandInt>().asLong() : frame.message<CommandLong>();
  const bool is_for_us = command.target_component == parameters_.component_id;
  if (command.target_system != 0 && command.target_system != parameters_.system_id) return;
  if (command.target_component != 0 && !is_for_us) return;
  const uint8_t result = execute(command, host_ns);
  // What is for all components and not for a camera, others answer.
  if (result == command_result::kUnsupported && !is_for_us) return;
  CommandAck answer;
  answer.command = command.command;
  answer.result = result;
  answer.target_system = frame.system;
  answer.target_component = frame.component;
  send(answer);
}

uint8_t TrackingCamera::execute(const CommandLong& command, int64_t host_ns) {
  switch (command.command) {
    case camera_command::kTrackPoint:
      return pickPoint(command, host_ns);
    case camera_command::kTrackRectangle:
      return pickRectangle(command, host_ns);
    case camera_command::kStopTracking:
      picked_.reset();
      mode_ = CameraTrackingImageStatus::kNoMode;
      return command_result::kAccepted;
    case camera_command::kStartMti:
    case camera_command::kStopMti:
      has_mti_ = command.command == camera_command::kStartMti;
      return command_result::kAccepted;
    case camera_command::kRequestCameraInformation:
      return sendRequested(CameraInformation::kId, host_ns);
    case camera_command::kRequestMessage:
    case camera_command::kSetMessageInterval: {
      const float id = command.param[0];
      if (!(id >= 0 && id < 16'777'216)) return command_result::kDenied;
      return command.command == camera_command::kRequestMessage
                 ? sendRequested(static_cast<uint32_t>(id), host_ns)
                 : setInterval(static_cast<uint32_t>(id), static_cast<double>(command.param[1]));
    }
    default:
      return command_result::kUnsupported;
  }
}

uint8_t TrackingCamera::setInterval(uint32_t message, double interval_us) {
  Stream* stream = message == CameraTrackingImageStatus::kId ? &image_
                   : message == CameraTrackingGeoStatus::kId ? &geo_
                                                             : nullptr;
  if (stream == nullptr) return command_result::kUnsupported;
  if (interval_us == -1) {
    stream->period_ns = 0;
  } else if (interval_us == 0) {
    stream->period_ns = periodOf(parameters_.rate_hz);
  } else if (interval_us >= kShortestInterval_us && interval_us <= kLongestInterval_us) {
    stream->period_ns = static_cast<int64_t>(interval_us * 1000);
  } else {
    return command_result::kDenied;
  }
  stream->next_ns = 0;
  return command_result::kAccepted;
}

uint8_t TrackingCamera::sendRequested(uint32_t message, int64_t host_ns) {
  if (message == CameraInformation::kId) {
    send(information(host_ns));
  } else if (message == CameraTrackingImageStatus::kId) {
    for (const Indicated& each : indicated(host_ns)) sendImageStatus(each);
  } else if (message == CameraTrackingGeoStatus::kId) {
    for (const Indicated& each : indicated(host_ns)) sendGeoStatus(each);
  } else {
    return command_result::kUnsupported;
  }
  return command_result::kAccepted;
}

void TrackingCamera::pick(int id, uint8_t mode, int64_t host_ns) {
  picked_ = id;
  mode_ = mode;
  picked_seen_ns_ = host_ns;
}

uint8_t TrackingCamera::pickPoint(const CommandLong& command, int64_t host_ns) {
  const float x = command.param[0], y = command.param[1];
  if (!isRelative(x) || !isRelative(y)) return command_result::kDenied;
  const double radius = isRelative(command.param[2]) ? static_cast<double>(command.param[2]) : 0;
  double nearest = std::max(radius, kPointTolerance);
  double smallest = std::numeric_limits<double>::infinity();
  const TrackedObject* found = nullptr;
  for (const TrackedObject& object : objects_) {
    if (!object.box || isStale(host_ns)) continue;
    const double distance = distanceOf(*object.box, x, y);
    const double area = object.box->area();
    // Of boxes that overlap at the point, the smaller: the larger is easily met beside it.
    if (distance > nearest || (distance == nearest && area >= smallest)) continue;
    nearest = distance;
    smallest = area;
    found = &object;
  }
  if (found == nullptr) return command_result::kFailed;
  pick(found->id, CameraTrackingImageStatus::kPointMode, host_ns);
  return command_result::kAccepted;
}

uint8_t TrackingCamera::pickRectangle(const CommandLong& command, int64_t host_ns) {
  for (int i = 0; i < 4; ++i) {
    if (!isRelative(command.param[i])) return command_result::kDenied;
  }
  const RelativeBox drawn{command.param[0], command.param[1], command.param[2], command.param[3]};
  if (drawn.right <= drawn.left || drawn.bottom <= drawn.top) return command_result::kDenied;
  double most = 0;
  const TrackedObject* found = nullptr;
  for (const TrackedObject& object : objects_) {
    if (!object.box || isStale(host_ns)) continue;
    const double overlap = overlapOf(drawn, *object.box);
    if (overlap <= most) continue;
    most = overlap;
    found = &object;
  }
  if (found == nullptr) return command_result::kFailed;
  pick(found->id, CameraTrackingImageStatus::kRectangleMode, host_ns);
  return command_result::kAccepted;
}

void TrackingCamera::show(std::vector<TrackedObject> objects, int64_t host_ns) {
  objects_ = std::move(objects);
  shown_ns_ = host_ns;
  const bool is_there = std::any_of(objects_.begin(), objects_.end(),
                                    [&](const TrackedObject& object) { return picked_ == object.id; });
  if (is_there) picked_seen_ns_ = host_ns;
}

std::vector<Bytes> TrackingCamera::dueFrames(int64_t host_ns) {
  trust_.advanceTo(host_ns, encoder_);
  if (host_ns >= next_heartbeat_ns_) {
    next_heartbeat_ns_ = host_ns + kHeartbeatPeriod_ns;
    send(Heartbeat{0, kCameraType, kNotAnAutopilot, 0, kActiveState, 3});
  }
  if (picked_ && !isStale(host_ns) && host_ns - picked_seen_ns_ > kLost_ns) {
    picked_.reset();
    mode_ = CameraTrackingImageStatus::kNoMode;
  }
  const bool has_image = image_.isDue(host_ns), has_geo = geo_.isDue(host_ns);
  if (has_image || has_geo) {
    for (const Indicated& each : indicated(host_ns)) {
      if (has_image) sendImageStatus(each);
      if (has_geo) sendGeoStatus(each);
    }
  }
  return std::exchange(outgoing_, {});
}

}  // namespace redbee::mavlink
