// Check of the kernel's UDP receive buffer. If it is too small, images are lost: LCM silently drops a message
// if one of its fragments is lost.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace redbee {

/// Traffic stays on the host (ttl=0); the buffer has room for more than a dozen raw 640x480 images.
constexpr const char* kDefaultLcmUrl = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304";
constexpr int64_t kRecommendedReceiveBuffer = 4194304;  ///< bytes

struct UdpBufferCheck {
  bool enough = true;
  std::string advice;  ///< one line with the exact fix; empty if the buffer is large enough
};

/// The value of `recv_buf_size` in an LCM URL [bytes]; std::nullopt if it is missing or not a positive
/// number.
std::optional<int64_t> receiveBufferOf(const std::string& url);

/// The kernel's limit, net.core.rmem_max [bytes]; std::nullopt if /proc has no such entry.
std::optional<int64_t> kernelReceiveBufferLimit();

/// Whether a receiver on this URL gets the buffer size that it requests, and requests enough. Always passes
/// for URLs that are not UDP.
UdpBufferCheck checkReceiveBuffer(const std::string& url, std::optional<int64_t> kernel_limit);
inline UdpBufferCheck checkReceiveBuffer(const std::string& url) {
  return checkReceiveBuffer(url, kernelReceiveBufferLimit());
}

}  // namespace redbee
