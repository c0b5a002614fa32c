#include "redbee/mavlink/link_address.hpp"

#include <gtest/gtest.h>

namespace redbee::mavlink {
namespace {

using Kind = LinkAddress::Kind;

TEST(MavlinkLink, ReadsEveryForm) {
  const auto serial = linkAddressOf("serial:/dev/ttyACM0:921600");
  ASSERT_TRUE(serial);
  EXPECT_EQ(serial->kind, Kind::kSerial);
  EXPECT_EQ(serial->place, "/dev/ttyACM0");
  EXPECT_EQ(serial->number, 921600U);
  EXPECT_EQ(linkAddressOf("serial:/dev/serial/by-id/usb-a:b:57600")->place, "/dev/serial/by-id/usb-a:b");
  EXPECT_EQ(linkAddressOf("udp:0.0.0.0:14540")->kind, Kind::kUdpListen);
  EXPECT_EQ(linkAddressOf("udpout:127.0.0.1:14580")->kind, Kind::kUdpSend);
}

TEST(MavlinkLink, RefusesTheRest) {
  for (const char* text :
       {"", "udp", "udp:14540", "udp:localhost:14540", "udp:127.0.0.1:0", "udp:127.0.0.1:65536",
        "udp:1.2.3:5", "udp:1.2.3.4.5:5", "udp:256.0.0.1:5", "udp:1.2.3.:5", "tcp:127.0.0.1:5760",
        "serial:ttyACM0:57600", "serial:/dev/ttyACM0:fast", "serial::57600",
        "serial:/dev/ttyACM0:", "udp:127.0.0.1:99999999999"}) {
    EXPECT_FALSE(linkAddressOf(text)) << text;
  }
}

}  // namespace
}  // namespace redbee::mavlink
