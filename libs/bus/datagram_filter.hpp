// What of LCM's UDP traffic a socket receives: of the rest, which every process on the network gets from the
// kernel otherwise, nothing is copied and nobody is woken.
#pragma once

#include <linux/filter.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "redbee/bus/message_length.hpp"

namespace redbee {

struct WantedChannel {
  std::string name;
  bool is_short;  ///< its messages have at most kShortMessage bytes
};

/// A program for SO_ATTACH_FILTER. It keeps LCM's messages on these channels. Only a message's first datagram
/// names the channel: the others are kept where the message may be one of these by its length. What is not of
/// LCM is kept.
std::vector<sock_filter> datagramFilter(const std::vector<WantedChannel>& wanted);

/// From now on the socket receives only what datagramFilter() says, or all, where the kernel cannot do so;
/// then false.
bool receiveOnly(int socket, const std::vector<WantedChannel>& wanted);

/// The file descriptors of this process's UDP sockets.
std::set<int> udpSockets();

}  // namespace redbee
