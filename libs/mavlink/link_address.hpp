// How an autopilot is reached: the text of the key autopilot.link.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace redbee::mavlink {

struct LinkAddress {
  enum class Kind { kSerial, kUdpListen, kUdpSend };
  Kind kind = Kind::kSerial;
  std::string place;    ///< device, or IPv4 address
  uint32_t number = 0;  ///< baud, or port
};

/// `serial:/dev/ttyACM0:921600`, `udp:0.0.0.0:14540` (listens there and answers whom it hears),
/// `udpout:127.0.0.1:14580` (speaks first); std::nullopt for anything else.
std::optional<LinkAddress> linkAddressOf(std::string_view text);
inline constexpr const char* kLinkForms = "serial:DEVICE:BAUD, udp:ADDRESS:PORT or udpout:ADDRESS:PORT";

}  // namespace redbee::mavlink
