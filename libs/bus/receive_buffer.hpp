// The kernel's receive buffer decides whether images arrive at all: LCM loses a message of which one
// fragment is lost, silently.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace redbee {

/// Traffic stays on the host (ttl=0); the buffer holds more than a dozen raw 640x480 images.
constexpr const char* kDefaultLcmUrl = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304";
constexpr int64_t kRecommendedReceiveBuffer = 4194304;  ///< bytes

struct UdpBufferCheck {
  bool enough = true;
  std::string advice;  ///< one line with the exact fix; empty where the buffer is large enough
};

/// The value of `recv_buf_size` in an LCM URL [bytes]; nothing where it has none that is a positive number.
std::optional<int64_t> receiveBufferOf(const std::string& url);

/// The kernel's limit, net.core.rmem_max [bytes]; nothing where /proc has no such entry.
std::optional<int64_t> kernelReceiveBufferLimit();

/// Whether a receiver on this URL gets the buffer it asks for, and asks for enough. URLs that are not UDP
/// need none.
UdpBufferCheck checkReceiveBuffer(const std::string& url, std::optional<int64_t> kernel_limit);
inline UdpBufferCheck checkReceiveBuffer(const std::string& url) {
  return checkReceiveBuffer(url, kernelReceiveBufferLimit());
}

}  // namespace redbee
