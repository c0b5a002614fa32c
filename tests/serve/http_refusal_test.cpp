// What the server does with requests before their bodies, and with answers of any size: over a socket.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <memory>
#include <string>

#include "processes/serve/http_server.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kToken = "0123456789abcdef";

class HttpRefusal : public testing::Test {
 protected:
  HttpRefusal() {
    writeText(folder_ / "flights/report.html", std::string(3'000'000, 'x') + "end");
    archive_ = std::make_unique<Archive>(Configuration(), std::vector<fs::path>{folder_ / "flights"});
    station_ =
        std::make_unique<Station>(Access(*address_, kToken, true), *archive_, live_, supervisedStack());
    server_ = std::make_unique<HttpServer>(*address_, *station_, live_);
  }

  /// Everything that the server sends until it ends the connection; `request` is all that it gets.
  std::string answerTo(const std::string& request) const {
    const int descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    address_->unix_socket.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(send(descriptor, request.data(), request.size(), 0), static_cast<ssize_t>(request.size()));
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

TEST_F(HttpRefusal, WithoutTheTokenNoBodyIsWaitedFor) {
  const std::string answer = answerTo(request("POST /api/record?on=1", "Content-Length: 4000000000\r\n"));
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 401 "));
  EXPECT_THAT(answer, HasSubstr("the token is missing"));
}

TEST_F(HttpRefusal, ABodyOfUnknownOrGreatLengthIsNotRead) {
  for (const char* length : {"Content-Length: 4000000000\r\n", "Transfer-Encoding: chunked\r\n"}) {
    const std::string answer =
        answerTo(request("POST /api/record?on=1", withToken() + "X-Redbee: 1\r\n" + length));
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 413 ")) << length;
    EXPECT_THAT(answer, EndsWith("no request to this page has such a body\n")) << length;
  }
}

TEST_F(HttpRefusal, EveryErrorHasALine) {
  for (const char* line : {"PUT /", "DELETE /api/record", "BREW /"}) {
    const std::string answer = answerTo(request(line, withToken() + "Connection: close\r\nX-Redbee: 1\r\n"));
    const size_t body = answer.find("\r\n\r\n");
    ASSERT_NE(body, std::string::npos) << line;
    EXPECT_GT(answer.size(), body + 4) << line << ": " << answer;
  }
}

TEST_F(HttpRefusal, AReportComesWhole) {
  const std::string answer =
      answerTo(request("GET /report?name=flights/report.html", withToken() + "Connection: close\r\n"));
  EXPECT_THAT(answer.substr(0, 15), StartsWith("HTTP/1.1 200 "));
  EXPECT_EQ(answer.size() - answer.find("\r\n\r\n") - 4, 3'000'003U);
  EXPECT_EQ(answer.substr(answer.size() - 4), "xend");
  EXPECT_THAT(answer.substr(0, 600), HasSubstr("sandbox"));
}

}  // namespace
}  // namespace redbee::test
