#include "processes/serve/access.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

constexpr size_t kShortestToken = 16;
constexpr size_t kLongestToken = 128;
constexpr const char* kCookie = "redbee_token";

WebResponse refuse(int status, const std::string& why) {
  WebResponse response;
  response.status = status;
  response.body = why + "\n";
  return response;
}

/// A Host header without its port; empty where it is malformed.
std::string hostOf(const std::string& header) {
  const bool is_bracketed = !header.empty() && header[0] == '[';
  size_t end = header.find(is_bracketed ? ']' : ':');
  if (is_bracketed && end != std::string::npos) ++end;
  end = std::min(end, header.size());
  const bool is_port = end == header.size() ||
                       (header[end] == ':' && std::all_of(header.begin() + end + 1, header.end(),
                                                          [](char c) { return c >= '0' && c <= '9'; }));
  return is_port ? header.substr(0, end) : "";
}

/// A name that merely begins like a loopback address may be anybody's: 127.0.0.1.evil.example.
bool isLoopback(const std::string& host) {
  if (host == "localhost") return true;
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return ntohl(v4.s_addr) >> 24 == IN_LOOPBACKNET;
  in6_addr v6{};
  return host.size() > 2 && host[0] == '[' && host.back() == ']' &&
         inet_pton(AF_INET6, host.substr(1, host.size() - 2).c_str(), &v6) == 1 && IN6_IS_ADDR_LOOPBACK(&v6);
}

}  // namespace

std::string readToken(const std::filesystem::path& file) {
  if (file.empty()) return "";
  requireSecret(file, "token");
  std::ifstream in(file);
  std::string token;
  std::getline(in, token);
  const bool is_printable = std::all_of(token.begin(), token.end(),
                                        [](char c) { return c > 0x20 && c < 0x7f && c != ';' && c != ','; });
  if (!is_printable || token.size() < kShortestToken || token.size() > kLongestToken)
    throw InputError(file, "is no token of 16 to 128 characters; openssl rand -hex 16 makes one");
  return token;
}

bool isSameSecret(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned>(static_cast<unsigned char>(b[i]));
  return difference == 0;
}

std::string cookieOf(const std::string& header, const std::string& name) {
  size_t at = 0;
  while (at < header.size()) {
    const size_t end = std::min(header.find(';', at), header.size());
    const size_t first = std::min(header.find_first_not_of(' ', at), end);
    const std::string pair = header.substr(first, end - first);
    if (pair.compare(0, name.size() + 1, name + "=") == 0) return pair.substr(name.size() + 1);
    at = end + 1;
  }
  return "";
}

Access::Access(const ListenAddress& address, std::string token, bool allow_writes)
    : token_(std::move(token)), allow_writes_(allow_writes) {
  if (!address.isLocal() && token_.empty()) {
    throw UserError("redbee serve: " + address.host +
                    " can be reached from other hosts: that needs serve.token_file (--token-file)");
  }
}

bool Access::hasToken(const WebRequest& request) const {
  const std::string bearer = "Bearer ";
  const std::string authorization = request.header("authorization");
  if (authorization.compare(0, bearer.size(), bearer) == 0)
    return isSameSecret(authorization.substr(bearer.size()), token_);
  return isSameSecret(cookieOf(request.header("cookie"), kCookie), token_);
}

/// A page of another site could otherwise lead a browser here under a name of its own (DNS rebinding); to a
/// Unix socket, too, where ssh -L makes it a port.
std::optional<WebResponse> Access::refusalOfHost(const WebRequest& request) const {
  if (isLoopback(hostOf(request.header("host")))) return std::nullopt;
  return refuse(403, "without a token this page is at localhost or 127.0.0.1 only");
}

/// Only our own page can set the header: for another site the browser would ask first, and gets no
/// permission.
std::optional<WebResponse> Access::refusalOfWrite(const WebRequest& request) const {
  if (request.method == "GET" || request.method == "HEAD") return std::nullopt;
  if (!allow_writes_) return refuse(403, "the page may only look: serve.allow_writes is false");
  if (request.header("x-redbee") != "1") return refuse(403, "a write without the header X-Redbee: 1");
  return std::nullopt;
}

std::optional<WebResponse> Access::refusal(const WebRequest& request) const {
  if (token_.empty()) {
    if (auto refused = refusalOfHost(request)) return refused;
    return refusalOfWrite(request);
  }
  // The address with the token is left at once, so that it is in no history and no later request.
  if (request.path == "/" && isSameSecret(request.parameter("token"), token_)) {
    WebResponse response = refuse(303, "");
    response.headers = {
        {"Location", "/"},
        {"Set-Cookie", std::string(kCookie) + "=" + token_ + "; HttpOnly; SameSite=Strict; Path=/"}};
    return response;
  }
  if (!hasToken(request))
    return refuse(401, "the token is missing: open /?token=... with that of serve.token_file");
  return refusalOfWrite(request);
}

}  // namespace redbee
