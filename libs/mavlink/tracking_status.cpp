// The members of TrackingCamera that say what is tracked.
#include <algorithm>
#include <cmath>
#include <limits>

#include "redbee/mavlink/tracking_camera.hpp"

namespace redbee::mavlink {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

std::vector<TrackingCamera::Indicated> TrackingCamera::indicated(int64_t host_ns) const {
  const uint8_t mti = has_mti_ ? tracking_status::kMti : tracking_status::kIdle;
  if (picked_) {
    if (isStale(host_ns)) return {{nullptr, tracking_status::kError}};
    const auto found = std::find_if(objects_.begin(), objects_.end(),
                                    [&](const TrackedObject& object) { return picked_ == object.id; });
    if (found == objects_.end())
      return {{nullptr, static_cast<uint8_t>(tracking_status::kActive | tracking_status::kCoasting)}};
    const uint8_t coasting = found->is_seen ? tracking_status::kIdle : tracking_status::kCoasting;
    return {{&*found, static_cast<uint8_t>(tracking_status::kActive | mti | coasting)}};
  }
  std::vector<Indicated> movers;
  for (const TrackedObject& object : objects_) {
    if (!has_mti_ || !object.box || isStale(host_ns)) continue;
    const uint8_t coasting = object.is_seen ? tracking_status::kIdle : tracking_status::kCoasting;
    movers.push_back({&object, static_cast<uint8_t>(mti | coasting)});
  }
  std::stable_sort(movers.begin(), movers.end(), [](const Indicated& a, const Indicated& b) {
    return a.object->box->area() > b.object->box->area();
  });
  if (movers.size() > kMostIndicated) movers.resize(kMostIndicated);
  if (movers.empty()) movers.push_back({nullptr, tracking_status::kIdle});
  return movers;
}

void TrackingCamera::sendImageStatus(const Indicated& each) {
  CameraTrackingImageStatus status;
  status.point_x = status.point_y = status.radius = kUnknown;
  status.rec_top_x = status.rec_top_y = status.rec_bottom_x = status.rec_bottom_y = kUnknown;
  status.tracking_status = each.status;
  status.tracking_mode = picked_ ? mode_ : CameraTrackingImageStatus::kNoMode;
  if (each.object != nullptr && each.object->box) {
    const RelativeBox& box = *each.object->box;
    if (!picked_) status.tracking_mode = CameraTrackingImageStatus::kRectangleMode;
    status.target_data = CameraTrackingImageStatus::kInStatus;
    status.point_x = static_cast<float>((box.left + box.right) / 2);
    status.point_y = static_cast<float>((box.top + box.bottom) / 2);
    status.radius = static_cast<float>(box.width() / 2);
    status.rec_top_x = static_cast<float>(box.left);
    status.rec_top_y = static_cast<float>(box.top);
    status.rec_bottom_x = static_cast<float>(box.right);
    status.rec_bottom_y = static_cast<float>(box.bottom);
  }
  send(status);
}

/// Nothing where the place on WGS-84 is not known: the message has no value for that.
void TrackingCamera::sendGeoStatus(const Indicated& each) {
  if (each.object == nullptr || !each.object->place) return;
  const ObjectPlace& place = *each.object->place;
  CameraTrackingGeoStatus status;
  status.tracking_status = each.status;
  status.lat = static_cast<int32_t>(std::lround(place.latitude_deg * 1e7));
  status.lon = static_cast<int32_t>(std::lround(place.longitude_deg * 1e7));
  status.alt = static_cast<float>(place.altitude_m);
  status.h_acc = static_cast<float>(place.sigma_m);
  status.v_acc = kUnknown;
  status.vel_n = static_cast<float>(place.north_m_s);
  status.vel_e = static_cast<float>(place.east_m_s);
  status.vel_d = 0;  // on level ground
  status.vel_acc = static_cast<float>(place.velocity_sigma_m_s);
  status.dist = static_cast<float>(place.distance_m);
  const double speed = std::hypot(place.north_m_s, place.east_m_s);
  const bool has_course = speed > place.velocity_sigma_m_s;
  status.hdg = has_course ? static_cast<float>(std::atan2(place.east_m_s, place.north_m_s)) : kUnknown;
  status.hdg_acc = has_course ? static_cast<float>(place.velocity_sigma_m_s / speed) : kUnknown;
  send(status);
}

CameraInformation TrackingCamera::information(int64_t host_ns) const {
  CameraInformation message;
  message.time_boot_ms = static_cast<uint32_t>(host_ns / 1'000'000);
  message.focal_length = message.sensor_size_h = message.sensor_size_v = kUnknown;
  message.flags = camera_capability::kTrackingPoint | camera_capability::kTrackingRectangle |
                  camera_capability::kTrackingGeoStatus | camera_capability::kMti;
  message.resolution_h = static_cast<uint16_t>(width_);
  message.resolution_v = static_cast<uint16_t>(height_);
  const std::string name = "REDBEE";
  std::copy(name.begin(), name.end(), message.vendor_name.begin());
  std::copy(name.begin(), name.end(), message.model_name.begin());
  return message;
}

}  // namespace redbee::mavlink
