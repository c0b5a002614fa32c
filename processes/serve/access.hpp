// Who may see the page, and who may write.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "processes/serve/web.hpp"
#include "redbee/configuration/listen_address.hpp"

namespace redbee {

/// The token in a file: printable characters without spaces, 16 to 128 of them, a line end behind them
/// allowed. Empty for an empty name. Throws InputError if it is no token or if every user may read it.
std::string readToken(const std::filesystem::path& file);

class Access {
 public:
  /// `token`: empty where none is demanded. Throws UserError where `address` is not local and there is none.
  Access(const ListenAddress& address, std::string token, bool allow_writes);

  /// std::nullopt if the request may be answered; otherwise the refusal, or the way to the page for who came
  /// with the token in the address.
  std::optional<WebResponse> refusal(const WebRequest& request) const;
  bool allowsWrites() const { return allow_writes_; }

 private:
  bool hasToken(const WebRequest& request) const;
  std::optional<WebResponse> refusalOfHost(const WebRequest& request) const;
  std::optional<WebResponse> refusalOfWrite(const WebRequest& request) const;

  std::string token_;
  bool allow_writes_;
};

/// Whether they are equal, in a time that does not depend on where they differ.
bool isSameSecret(const std::string& a, const std::string& b);

/// The value of the cookie `name` in a Cookie header; empty where there is none.
std::string cookieOf(const std::string& header, const std::string& name);

}  // namespace redbee
