#include "redbee/configuration/listen_address.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>

namespace redbee {
namespace {

constexpr size_t kLongestSocket = 107;  ///< bytes, of a Unix socket's name (unix(7))

bool isPrintable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c != 0x7f; });
}

}  // namespace

std::optional<ListenAddress> listenAddressOf(std::string_view text) {
  constexpr std::string_view kUnix = "unix:";
  ListenAddress address;
  if (text.substr(0, kUnix.size()) == kUnix) {
    address.unix_socket = text.substr(kUnix.size());
    const size_t length = address.unix_socket.size();
    if (length == 0 || length > kLongestSocket || !isPrintable(address.unix_socket)) return std::nullopt;
    return address;
  }
  const size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  address.host = text.substr(0, colon);
  in_addr parsed{};
  if (inet_pton(AF_INET, address.host.c_str(), &parsed) != 1) return std::nullopt;
  const std::string_view port = text.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (error != std::errc() || end != port.data() + port.size() || address.port == 0) return std::nullopt;
  return address;
}

}  // namespace redbee
