// What a camera says of itself; see messages.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace redbee::mavlink {

struct CameraInformation {
  static constexpr uint32_t kId = 259;
  static constexpr std::string_view kName = "CAMERA_INFORMATION";
  uint32_t time_boot_ms = 0;
  uint32_t firmware_version = 0;
  float focal_length = 0;   ///< mm; NaN or 0: unknown
  float sensor_size_h = 0;  ///< mm
  float sensor_size_v = 0;
  uint32_t flags = 0;
  uint16_t resolution_h = 0;  ///< px
  uint16_t resolution_v = 0;
  uint16_t cam_definition_version = 0;
  std::array<uint8_t, 32> vendor_name{};
  std::array<uint8_t, 32> model_name{};
  uint8_t lens_id = 0;
  std::array<char, 140> cam_definition_uri{};
  uint8_t gimbal_device_id = 0;
  uint8_t camera_device_id = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_boot_ms", m.time_boot_ms);
    v("firmware_version", m.firmware_version);
    v("focal_length", m.focal_length);
    v("sensor_size_h", m.sensor_size_h);
    v("sensor_size_v", m.sensor_size_v);
    v("flags", m.flags);
    v("resolution_h", m.resolution_h);
    v("resolution_v", m.resolution_v);
    v("cam_definition_version", m.cam_definition_version);
    v("vendor_name", m.vendor_name);
    v("model_name", m.model_name);
    v("lens_id", m.lens_id);
    v("cam_definition_uri", m.cam_definition_uri);
    v.extensions();
    v("gimbal_device_id", m.gimbal_device_id);
    v("camera_device_id", m.camera_device_id);
  }
};

struct CameraSettings {
  static constexpr uint32_t kId = 260;
  static constexpr std::string_view kName = "CAMERA_SETTINGS";
  uint32_t time_boot_ms = 0;
  uint8_t mode_id = 0;
  float zoom_level = 0;  ///< percent of the range; NaN: unknown
  float focus_level = 0;
  uint8_t camera_device_id = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_boot_ms", m.time_boot_ms);
    v("mode_id", m.mode_id);
    v.extensions();
    v("zoomLevel", m.zoom_level);
    v("focusLevel", m.focus_level);
    v("camera_device_id", m.camera_device_id);
  }
};

struct CameraFovStatus {
  static constexpr uint32_t kId = 271;
  static constexpr std::string_view kName = "CAMERA_FOV_STATUS";
  uint32_t time_boot_ms = 0;
  int32_t lat_camera = 0, lon_camera = 0;  ///< 1e-7 deg
  int32_t alt_camera = 0;                  ///< mm above mean sea level
  int32_t lat_image = 0, lon_image = 0, alt_image = 0;
  std::array<float, 4> q{};
  float hfov = 0, vfov = 0;  ///< deg; NaN: unknown
  uint8_t camera_device_id = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_boot_ms", m.time_boot_ms);
    v("lat_camera", m.lat_camera);
    v("lon_camera", m.lon_camera);
    v("alt_camera", m.alt_camera);
    v("lat_image", m.lat_image);
    v("lon_image", m.lon_image);
    v("alt_image", m.alt_image);
    v("q", m.q);
    v("hfov", m.hfov);
    v("vfov", m.vfov);
    v.extensions();
    v("camera_device_id", m.camera_device_id);
  }
};

}  // namespace redbee::mavlink
