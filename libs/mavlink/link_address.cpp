#include "redbee/mavlink/link_address.hpp"

#include <algorithm>
#include <cctype>

namespace redbee::mavlink {
namespace {

bool isDigits(std::string_view text, size_t most) {
  return !text.empty() && text.size() <= most && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
  });
}

/// Four numbers to 255: a name would have to be looked up, which takes as long as it takes.
bool isIpv4(std::string_view text) {
  for (int part = 0; part < 4; ++part) {
    const size_t end = part < 3 ? text.find('.') : text.size();
    if (end == std::string_view::npos || !isDigits(text.substr(0, end), 3)) return false;
    if (std::stoi(std::string(text.substr(0, end))) > 255) return false;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return text.empty();
}

}  // namespace

std::optional<LinkAddress> linkAddressOf(std::string_view text) {
  const size_t first = text.find(':');
  const size_t last = text.rfind(':');
  if (first == std::string_view::npos || first == last) return std::nullopt;
  const std::string_view scheme = text.substr(0, first);
  const std::string_view number = text.substr(last + 1);
  LinkAddress address;
  address.place = text.substr(first + 1, last - first - 1);
  if (!isDigits(number, 8)) return std::nullopt;
  address.number = static_cast<uint32_t>(std::stoul(std::string(number)));
  if (address.number == 0) return std::nullopt;
  if (scheme == "serial") {
    if (address.place.empty() || address.place.front() != '/') return std::nullopt;
    return address;
  }
  if (scheme != "udp" && scheme != "udpout") return std::nullopt;
  if (!isIpv4(address.place) || address.number > 65535) return std::nullopt;
  address.kind = scheme == "udp" ? LinkAddress::Kind::kUdpListen : LinkAddress::Kind::kUdpSend;
  return address;
}

}  // namespace redbee::mavlink
