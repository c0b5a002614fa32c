#include "redbee/bus/receive_buffer.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>

namespace redbee {
namespace {

bool startsWith(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

}  // namespace

std::optional<int64_t> receiveBufferOf(const std::string& url) {
  const std::string key = "recv_buf_size=";
  const size_t options = url.find('?');
  if (options == std::string::npos) return std::nullopt;
  for (size_t at = options; at != std::string::npos; at = url.find('&', at + 1)) {
    if (url.compare(at + 1, key.size(), key) != 0) continue;
    const char* first = url.data() + at + 1 + key.size();
    const char* last = url.data() + std::min(url.find('&', at + 1), url.size());
    int64_t bytes = 0;
    const auto [end, error] = std::from_chars(first, last, bytes);
    if (error == std::errc() && end == last && bytes > 0) return bytes;
  }
  return std::nullopt;
}

std::optional<int64_t> kernelReceiveBufferLimit() {
  std::ifstream file("/proc/sys/net/core/rmem_max");
  int64_t bytes = 0;
  if (!(file >> bytes)) return std::nullopt;
  return bytes;
}

UdpBufferCheck checkReceiveBuffer(const std::string& url, std::optional<int64_t> kernel_limit) {
  if (!startsWith(url, "udpm://") && !startsWith(url, "mpudpm://")) return {};
  const auto wanted = receiveBufferOf(url);
  const std::string recommended = std::to_string(kRecommendedReceiveBuffer);
  if (!wanted) {
    return {false, "images will be lost: the URL " + url +
                       " names no receive buffer; add recv_buf_size=" + recommended};
  }
  if (kernel_limit && *kernel_limit < *wanted) {
    return {false, "images will be lost: the kernel caps receive buffers at " +
                       std::to_string(*kernel_limit) +
                       " bytes; as root: sysctl -w net.core.rmem_max=" + std::to_string(*wanted)};
  }
  if (*wanted < kRecommendedReceiveBuffer) {
    return {false, "images may be lost: the receive buffer in the URL " + url +
                       " is small; use recv_buf_size=" + recommended};
  }
  return {};
}

}  // namespace redbee
