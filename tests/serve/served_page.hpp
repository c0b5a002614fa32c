// The page behind a Unix socket, and what comes back for bytes that are sent to it.
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <memory>
#include <optional>
#include <string>

#include "processes/serve/http_server.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {

inline constexpr const char* kToken = "0123456789abcdef";

class ServedPage : public testing::Test {
 protected:
  ServedPage() {
    writeText(folder_ / "flights/report.html", std::string(3'000'000, 'x') + "end");
    archive_ = std::make_unique<Archive>(Configuration(), std::vector<fs::path>{folder_ / "flights"});
    station_ =
        std::make_unique<Station>(Access(*address_, kToken, true), *archive_, live_, supervisedStack());
    server_ = std::make_unique<HttpServer>(*address_, *station_, live_);
  }

  /// To be closed by the caller.
  int connected() const {
    const int descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    address_->unix_socket.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    return descriptor;
  }
  /// Everything that the server sends until it ends the connection; `request` is all that it gets.
  std::string answerTo(const std::string& request) const {
    const int descriptor = connected();
    EXPECT_EQ(send(descriptor, request.data(), request.size(), 0), static_cast<ssize_t>(request.size()));
    return restOf(descriptor);
  }
  /// Everything until the server ends the connection, or the descriptor's time limit; it is closed then.
  static std::string restOf(int descriptor) {
    std::string answer;
    char part[65536];
    for (ssize_t n = 0; (n = recv(descriptor, part, sizeof part, 0)) > 0;)
      answer.append(part, static_cast<size_t>(n));
    close(descriptor);
    return answer;
  }
  static std::string request(const std::string& line, const std::string& headers) {
    return line + " HTTP/1.1\r\nHost: localhost\r\n" + headers + "\r\n";
  }
  static std::string withToken() { return std::string("Authorization: Bearer ") + kToken + "\r\n"; }

  ScratchFolder folder_;
  std::optional<ListenAddress> address_ = listenAddressOf("unix:" + (folder_ / "serve.sock").string());
  Live live_;
  std::unique_ptr<Archive> archive_;
  std::unique_ptr<Station> station_;
  std::unique_ptr<HttpServer> server_;
};

}  // namespace redbee::test
