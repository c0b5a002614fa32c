// The messages of a camera that tracks; see messages.hpp. Image coordinates are 0..1 from the left and upper
// edge, NaN where unknown.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace redbee::mavlink {

/// CAMERA_TRACKING_STATUS_FLAGS, a bitmask.
namespace tracking_status {
inline constexpr uint8_t kIdle = 0, kActive = 1, kError = 2, kMti = 4, kCoasting = 8;
}
/// CAMERA_CAP_FLAGS, a bitmask.
namespace camera_capability {
inline constexpr uint32_t kTrackingPoint = 512, kTrackingRectangle = 1024, kTrackingGeoStatus = 2048,
                          kMti = 8192;
}
/// MAV_CMD. START_MTI and STOP_MTI are of development.xml.
namespace camera_command {
inline constexpr uint16_t kSetMessageInterval = 511, kRequestMessage = 512, kRequestCameraInformation = 521,
                          kTrackPoint = 2004, kTrackRectangle = 2005, kStopTracking = 2010, kStartMti = 2020,
                          kStopMti = 2021;
}
/// MAV_RESULT.
namespace command_result {
inline constexpr uint8_t kAccepted = 0, kDenied = 2, kUnsupported = 3, kFailed = 4;
}

struct CameraTrackingImageStatus {
  static constexpr uint32_t kId = 275;
  static constexpr std::string_view kName = "CAMERA_TRACKING_IMAGE_STATUS";
  static constexpr uint8_t kNoMode = 0, kPointMode = 1, kRectangleMode = 2;  ///< of `tracking_mode`
  static constexpr uint8_t kInStatus = 4;                                    ///< of `target_data`
  float point_x = 0;
  float point_y = 0;
  float radius = 0;  ///< of the image's width
  float rec_top_x = 0;
  float rec_top_y = 0;
  float rec_bottom_x = 0;
  float rec_bottom_y = 0;
  uint8_t tracking_status = 0;
  uint8_t tracking_mode = 0;
  uint8_t target_data = 0;
  uint8_t camera_device_id = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("point_x", m.point_x);
    v("point_y", m.point_y);
    v("radius", m.radius);
    v("rec_top_x", m.rec_top_x);
    v("rec_top_y", m.rec_top_y);
    v("rec_bottom_x", m.rec_bottom_x);
    v("rec_bottom_y", m.rec_bottom_y);
    v("tracking_status", m.tracking_status);
    v("tracking_mode", m.tracking_mode);
    v("target_data", m.target_data);
    v.extensions();
    v("camera_device_id", m.camera_device_id);
  }
};

struct CameraTrackingGeoStatus {
  static constexpr uint32_t kId = 276;
  static constexpr std::string_view kName = "CAMERA_TRACKING_GEO_STATUS";
  int32_t lat = 0;  ///< 1e-7 deg
  int32_t lon = 0;
  float alt = 0;    ///< m above mean sea level
  float h_acc = 0;  ///< m
  float v_acc = 0;
  float vel_n = 0;  ///< m/s
  float vel_e = 0;
  float vel_d = 0;
  float vel_acc = 0;
  float dist = 0;  ///< m, from the camera
  float hdg = 0;   ///< rad, in NED
  float hdg_acc = 0;
  uint8_t tracking_status = 0;
  uint8_t camera_device_id = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("lat", m.lat);
    v("lon", m.lon);
    v("alt", m.alt);
    v("h_acc", m.h_acc);
    v("v_acc", m.v_acc);
    v("vel_n", m.vel_n);
    v("vel_e", m.vel_e);
    v("vel_d", m.vel_d);
    v("vel_acc", m.vel_acc);
    v("dist", m.dist);
    v("hdg", m.hdg);
    v("hdg_acc", m.hdg_acc);
    v("tracking_status", m.tracking_status);
    v.extensions();
    v("camera_device_id", m.camera_device_id);
  }
};

}  // namespace redbee::mavlink
