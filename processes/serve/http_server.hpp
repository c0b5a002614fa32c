// Station over HTTP, by cpp-httplib.
#pragma once

#include <memory>
#include <string>

#include "processes/serve/station.hpp"
#include "redbee/configuration/listen_address.hpp"

namespace redbee {

/// Serves from its construction to its end, in threads of its own.
class HttpServer {
 public:
  /// Throws UserError if it cannot listen there. A Unix socket that an earlier run left is replaced; who is
  /// not of this user or group cannot open it.
  HttpServer(const ListenAddress& address, Station& station, Live& live);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace redbee
