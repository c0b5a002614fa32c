// Where the ground station's page is served: the text of the key serve.listen.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace redbee {

struct ListenAddress {
  std::string unix_socket;  ///< file of a Unix socket; empty: TCP
  std::string host;         ///< IPv4 address
  uint16_t port = 0;

  /// Whoever is not on this host, or may not open the socket, cannot reach it.
  bool isLocal() const { return !unix_socket.empty() || host.rfind("127.", 0) == 0; }
};

/// `127.0.0.1:8080` (ADDRESS:PORT, an IPv4 address), `unix:serve.sock` (a file, from the working folder
/// unless it begins with /); std::nullopt for anything else.
std::optional<ListenAddress> listenAddressOf(std::string_view text);
inline constexpr const char* kListenForms = "ADDRESS:PORT, such as 127.0.0.1:8080, or unix:FILE";

}  // namespace redbee
