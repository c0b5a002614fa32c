// Datagrams that the kernel dropped at this process' UDP sockets: LCM loses such messages silently.
#pragma once

#include <cstdint>
#include <istream>
#include <set>

namespace redbee {

/// Packets dropped, for want of room in the receive buffer, at all UDP sockets of this process since they
/// were opened; 0 where /proc has no such entry.
int64_t droppedPackets();

/// The same from a table in the form of /proc/net/udp, of the sockets with these inodes.
int64_t droppedPackets(std::istream& table, const std::set<uint64_t>& inodes);

}  // namespace redbee
