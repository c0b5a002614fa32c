#include "processes/link/link.hpp"

#include <utility>

#include "processes/link/serial_link.hpp"
#include "processes/link/udp_link.hpp"

namespace redbee {

std::unique_ptr<Link> makeLink(const mavlink::LinkAddress& address, PeerCheck is_peer) {
  if (address.kind == mavlink::LinkAddress::Kind::kSerial) {
    return std::make_unique<SerialLink>(address.place, address.number);
  }
  return std::make_unique<UdpLink>(address.place, static_cast<uint16_t>(address.number),
                                   address.kind == mavlink::LinkAddress::Kind::kUdpListen,
                                   std::move(is_peer));
}

}  // namespace redbee
