// The device or socket behind which the autopilot is.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "redbee/mavlink/link_address.hpp"

namespace redbee {

/// What arrived together, and when.
struct ReceivedBytes {
  std::vector<uint8_t> data;  ///< empty: nothing did
  /// Our clock (libs/node/host_clock.hpp), when they had been read: a time before that may be one before they
  /// arrived, which no delay explains.
  int64_t host_ns = 0;
};

/// May be opened again after it failed.
class Link {
 public:
  virtual ~Link() = default;
  /// Returns what is wrong, in one line; empty where the link is open now.
  virtual std::string open() = 0;
  virtual bool isOpen() const = 0;
  /// Waits up to `timeout` for bytes. Where the device is gone the link is closed.
  virtual ReceivedBytes receive(std::chrono::milliseconds timeout) = 0;
  /// Never waits: what the device does not take now is dropped. False where anything was.
  virtual bool send(const std::vector<uint8_t>& data) = 0;
  /// Whether what arrives together holds whole frames.
  virtual bool isDatagram() const = 0;
};

/// Whether a datagram is of whom a listening link is to speak with.
using PeerCheck = std::function<bool(const std::vector<uint8_t>& datagram)>;

/// Throws UserError for a speed that the system's serial ports do not have. Without a check anybody may be
/// the peer of a UDP port that listens.
std::unique_ptr<Link> makeLink(const mavlink::LinkAddress& address, PeerCheck is_peer = {});

}  // namespace redbee
