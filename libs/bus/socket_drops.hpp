// Datagrams that the kernel dropped at this process's UDP sockets. LCM does not report the messages lost with
// them.
#pragma once

#include <cstdint>
#include <istream>
#include <set>

namespace redbee {

/// Packets dropped because the receive buffer was full, or by a datagramFilter(), over all UDP sockets of
/// this process since they were opened; 0 if /proc has no such entry.
int64_t droppedPackets();

/// The same for the sockets with these inodes, from a table in the format of /proc/net/udp.
int64_t droppedPackets(std::istream& table, const std::set<uint64_t>& inodes);

}  // namespace redbee
