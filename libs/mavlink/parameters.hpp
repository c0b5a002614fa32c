// What a vehicle file says of its autopilot.
#pragma once

#include <string>

namespace redbee {

struct AutopilotParameters {
  std::string link;   ///< serial:DEVICE:BAUD, udp:ADDRESS:PORT (listens) or udpout:HOST:PORT; empty: none
  int system_id = 1;  ///< of the vehicle, as in the autopilot's SYSID_THISMAV or MAV_SYS_ID
  std::string
      signing_key_file;  ///< 64 hexadecimal digits; empty: frames are not signed, and signatures not checked
  double imu_rate_hz = 200;      ///< Hz, asked of the autopilot
  double attitude_rate_hz = 50;  ///< Hz, the same, of the attitude: the rate of POSE and GIMBAL
  double position_rate_hz = 10;  ///< Hz, the same, of position, GPS, distance sensor, field of view
  double attitude_sigma_deg =
      1.0;  ///< deg, one standard deviation of roll and pitch, which the autopilot does not send
  double heading_sigma_deg = 5.0;         ///< deg, the same of the heading, unless GPS_RAW_INT has it
  double rangefinder_above_camera_m = 0;  ///< m, of the distance sensor, along the body's vertical
};

/// Of the section `ground_link`.
struct GroundLinkParameters {
  std::string link;              ///< linkAddressOf(); empty: none
  int system_id = 1;             ///< of the vehicle
  int component_id = 100;        ///< MAV_COMP_ID_CAMERA
  std::string signing_key_file;  ///< of 64 hexadecimal digits; empty: frames are not signed
  double rate_hz = 5;            ///< Hz, of each status message
};

}  // namespace redbee
