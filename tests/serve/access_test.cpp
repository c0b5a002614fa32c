// Who gets an answer: hosts, tokens, writes.
#include "processes/serve/access.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "redbee/files/input_error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

using testing::HasSubstr;
const std::string kToken = "0123456789abcdef";

Access accessAt(const std::string& address, const std::string& token = "", bool writes = false) {
  return {*listenAddressOf(address), token, writes};
}

WebRequest request(const std::string& method, const std::map<std::string, std::string>& headers,
                   const std::string& path = "/") {
  return {method, path, {}, headers};
}

int statusOf(const Access& access, const WebRequest& from) {
  const auto refused = access.refusal(from);
  return refused ? refused->status : 200;
}

TEST(ListenAddress, IsAnAddressWithAPortOrAUnixSocket) {
  EXPECT_EQ(listenAddressOf("0.0.0.0:80")->port, 80);
  EXPECT_FALSE(listenAddressOf("0.0.0.0:80")->isLocal());
  EXPECT_TRUE(listenAddressOf("127.0.0.1:8080")->isLocal());
  EXPECT_EQ(listenAddressOf("unix:serve.sock")->unix_socket, "serve.sock");
  for (const char* wrong : {"", ":80", "127.0.0.1", "127.0.0.1:", "127.0.0.1:0", "127.0.0.1:65536",
                            "localhost:80", "127.0.0.1:80x", "unix:", "1.2.3:80", "127.1:80", "[::1]:80"}) {
    EXPECT_FALSE(listenAddressOf(wrong)) << wrong;
  }
  EXPECT_FALSE(listenAddressOf("unix:" + std::string(108, 'x')));
}

TEST(Access, NeedsATokenWhereOtherHostsReachIt) {
  EXPECT_THROW(accessAt("0.0.0.0:8080"), UserError);
  EXPECT_THROW(accessAt("192.168.2.1:8080"), UserError);
  EXPECT_NO_THROW(accessAt("192.168.2.1:8080", kToken));
  EXPECT_NO_THROW(accessAt("unix:serve.sock"));
}

TEST(Access, WithoutATokenAnswersOnlyUnderNamesOfThisHost) {
  // At a Unix socket, too: ssh -L makes it a port of the viewer's own host.
  for (const char* address : {"127.0.0.1:8080", "unix:serve.sock"}) {
    const Access access = accessAt(address);
    for (const char* host : {"127.0.0.1:8080", "127.0.0.1", "127.1.2.3:80", "localhost:8080", "localhost",
                             "[::1]:8080", "[::1]"})
      EXPECT_EQ(statusOf(access, request("GET", {{"host", host}})), 200) << address << " " << host;
    for (const char* host : {"evil.example:8080", "127.evil.example", "127.0.0.1.evil.example:8080",
                             "localhost.evil.example:8080", "localhost.", "128.0.0.1", "127.0.0.1:80:80",
                             "127.0.0.1:x", "[::2]:8080", "::1", "[127.0.0.1]", "[::1]x", "[::1", ""})
      EXPECT_EQ(statusOf(access, request("GET", {{"host", host}})), 403) << address << " " << host;
    EXPECT_EQ(statusOf(access, request("GET", {})), 403) << address;
  }
}

TEST(Access, TakesTheTokenFromHeaderCookieAndAddress) {
  const Access access = accessAt("0.0.0.0:8080", kToken);
  EXPECT_EQ(statusOf(access, request("GET", {})), 401);
  EXPECT_EQ(statusOf(access, request("GET", {{"authorization", "Bearer " + kToken}})), 200);
  EXPECT_EQ(statusOf(access, request("GET", {{"authorization", "Bearer " + kToken + "0"}})), 401);
  EXPECT_EQ(statusOf(access, request("GET", {{"cookie", "a=b; redbee_token=" + kToken}})), 200);
  EXPECT_EQ(statusOf(access, request("GET", {{"cookie", "xredbee_token=" + kToken}})), 401);
  EXPECT_EQ(statusOf(access, request("GET", {{"cookie", "redbee_token="}})), 401);
  WebRequest first = request("GET", {});
  first.query["token"] = kToken;
  const auto redirect = access.refusal(first);
  ASSERT_TRUE(redirect);
  EXPECT_EQ(redirect->status, 303);
  EXPECT_THAT(redirect->headers[1].second,
              HasSubstr("redbee_token=" + kToken + "; HttpOnly; SameSite=Strict"));
  first.path = "/api/frame";
  EXPECT_EQ(statusOf(access, first), 401);
}

TEST(Access, WritesNeedTheSwitchAndOurOwnPage) {
  const std::map<std::string, std::string> from_page{{"host", "localhost"}, {"x-redbee", "1"}};
  EXPECT_EQ(statusOf(accessAt("127.0.0.1:1"), request("POST", from_page)), 403);
  EXPECT_EQ(statusOf(accessAt("127.0.0.1:1", "", true), request("POST", from_page)), 200);
  EXPECT_EQ(statusOf(accessAt("127.0.0.1:1", "", true), request("POST", {{"host", "localhost"}})), 403);
  EXPECT_EQ(statusOf(accessAt("127.0.0.1:1", kToken, true), request("POST", from_page)), 401);
}

TEST(Token, IsRefusedWhereItIsShortOrReadableByAll) {
  const ScratchFolder folder;
  const auto file = folder / "token";
  writeText(file, kToken + "\n");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(readToken(file), kToken);
  fs::permissions(file, fs::perms::others_read, fs::perm_options::add);
  EXPECT_THROW(readToken(file), InputError);
  writeText(folder / "short", "abc\n");
  EXPECT_THROW(readToken(folder / "short"), InputError);
  EXPECT_THROW(readToken(folder / "none"), InputError);
  EXPECT_EQ(readToken(""), "");
}

}  // namespace
}  // namespace redbee::test
