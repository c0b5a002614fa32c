#include "processes/serve/http_server.hpp"

#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "processes/serve/bounded_server.hpp"
#include "redbee/files/new_file.hpp"
#include "redbee/files/user_error.hpp"

namespace redbee {
namespace {

constexpr size_t kLongestBody = 4096;    ///< bytes; no request of ours has one
constexpr size_t kFilePart = 64 * 1024;  ///< bytes
constexpr std::chrono::milliseconds kKeepAlive{1000};
constexpr std::chrono::milliseconds kStopPeriod{200};  ///< in which it is seen that the server stops

WebRequest requestOf(const httplib::Request& from) {
  WebRequest request{from.method, from.path, {}, {}};
  for (const auto& [name, value] : from.params) request.query.emplace(name, value);
  for (const auto& [name, value] : from.headers) {
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    request.headers.emplace(std::move(lower), value);
  }
  return request;
}

std::string eventsSince(Live::Sent& sent, Live& live, bool& is_closed) {
  const Live::Update update = live.wait(sent, kKeepAlive);
  is_closed = update.is_closed;
  std::string text;
  if (update.frame) {
    sent.frame = update.frame->sequence();
    text += "event: frame\ndata: " + std::to_string(sent.frame) + "\n\n";
  }
  if (!update.health.empty()) {
    sent.health = update.health_sequence;
    text += "event: health\ndata: " + update.health + "\n\n";
  }
  if (!update.map.empty()) {
    sent.map = update.map_sequence;
    text += "event: map\ndata: " + update.map + "\n\n";
  }
  return text.empty() ? ": nothing new\n\n" : text;
}

/// Each viewer is sent what is newest when its connection takes it.
void streamEvents(Live& live, httplib::Response& response) {
  auto viewer = live.join();
  if (!viewer) {
    response.status = 503;
    response.set_content("too many viewers\n", "text/plain");
    return;
  }
  auto joined = std::make_shared<Live::Viewer>(std::move(*viewer));
  auto sent = std::make_shared<Live::Sent>();
  response.set_chunked_content_provider(
      "text/event-stream", [&live, joined, sent, is_first = true](size_t, httplib::DataSink& sink) mutable {
        if (std::exchange(is_first, false)) {
          const std::string begin = "retry: 500\n\n";
          return sink.write(begin.data(), begin.size());
        }
        bool is_closed = false;
        const std::string text = eventsSince(*sent, live, is_closed);
        if (is_closed) return false;
        return sink.write(text.data(), text.size());
      });
}

/// Every answer is sent whole, as a server may (RFC 9110, 14.2): httplib takes a range's end from the client,
/// also one beyond the answer's. The request is the server's own, which it reads the ranges of again when it
/// answers.
void ignoreRanges(const httplib::Request& request) {
  const_cast<httplib::Request&>(request).ranges.clear();  // NOLINT(*-const-cast)
}

/// The body is sent and the connection ends: what the client still sends of its own is read by nobody.
void refuse(const WebResponse& refusal, httplib::Response& to) {
  to.status = refusal.status;
  for (const auto& [name, value] : refusal.headers) to.set_header(name, value);
  to.set_header("Connection", "close");
  to.set_content_provider(refusal.body.size(), refusal.type,
                          [body = refusal.body](size_t offset, size_t length, httplib::DataSink& sink) {
                            sink.write(body.data() + offset, length);
                            return false;
                          });
}

/// A file of any size takes no more memory than a part of it. One that has shrunk since ends the connection.
void streamFile(const WebResponse& response, httplib::Response& to) {
  const auto file = std::make_shared<std::ifstream>(response.file, std::ios::binary);
  if (!*file) {
    to.status = 404;
    to.set_content("the file is gone\n", "text/plain");
    return;
  }
  to.set_content_provider(
      response.file_bytes, response.type,
      [file, read_by = response.read_by](size_t offset, size_t length, httplib::DataSink& sink) {
        std::array<char, kFilePart> part;
        file->seekg(static_cast<std::streamoff>(offset));
        file->read(part.data(), static_cast<std::streamsize>(std::min(length, part.size())));
        return file->gcount() > 0 && sink.write(part.data(), static_cast<size_t>(file->gcount()));
      });
}

/// What httplib itself answers (a method that is not known, a header too long) has no body.
void explainError(const httplib::Request&, httplib::Response& to) {
  if (!to.body.empty() || to.content_length_ > 0) return;
  to.set_content(std::to_string(to.status) + ": this server does not answer such a request\n", "text/plain");
}

/// What a server that was killed has left is removed; that of one which lives is not.
void removeLeftSocket(const std::string& file) {
  struct stat status {};
  if (lstat(file.c_str(), &status) != 0 || !S_ISSOCK(status.st_mode)) return;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  file.copy(address.sun_path, sizeof address.sun_path - 1);
  const FileDescriptor probe(socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const bool is_answered =
      connect(probe.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  if (!is_answered && errno == ECONNREFUSED) {
    std::filesystem::remove(file);
    return;
  }
  // EAGAIN: more are waiting than it takes.
  const std::string why = is_answered || errno == EAGAIN
                              ? "another server listens there"
                              : std::string("cannot be asked who listens: ") + std::strerror(errno);
  throw UserError("redbee serve: " + file + ": " + why + "; another socket: --listen unix:FILE");
}

void listenAt(httplib::Server& server, const ListenAddress& address) {
  if (address.unix_socket.empty()) {
    if (!server.bind_to_port(address.host, address.port)) {
      throw UserError("redbee serve: cannot listen at " + address.host + ":" + std::to_string(address.port) +
                      ": " + std::strerror(errno) + "; another port: --listen 127.0.0.1:PORT");
    }
    return;
  }
  removeLeftSocket(address.unix_socket);
  server.set_address_family(AF_UNIX);
  const mode_t before = umask(0117);  // user and group
  const bool is_bound = server.bind_to_port(address.unix_socket, 80);
  const int error = errno;
  umask(before);
  if (!is_bound)
    throw UserError("redbee serve: " + address.unix_socket + ": cannot listen: " + std::strerror(error));
}

}  // namespace

struct HttpServer::Implementation {
  BoundedServer server{endProcess};
  std::thread thread;

  /// httplib listens no more after any error of accept(), as where the kernel has no memory for the moment: a
  /// process that then went on would never be reached again.
  static void endProcess() {
    spdlog::critical("redbee-serve: takes no connections any more, and ends to be started again");
    std::raise(SIGTERM);
  }
};

HttpServer::HttpServer(const ListenAddress& address, Station& station, Live& live)
    : implementation_(std::make_unique<Implementation>()) {
  BoundedServer& server = implementation_->server;
  server.set_payload_max_length(kLongestBody);
  // Nothing else ends the wait at a Unix socket when the server is to stop.
  server.set_idle_interval(kStopPeriod);
  server.set_tcp_nodelay(true);
  // Not httplib's SO_REUSEPORT: a second server would be given half of the connections.
  server.set_socket_options([](int socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_default_headers({{"Cache-Control", "no-store"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"}});
  const auto handle = [&station, &live](const httplib::Request& from, httplib::Response& to) {
    const WebResponse response = station.answer(requestOf(from));
    if (response.is_event_stream) return streamEvents(live, to);
    to.status = response.status;
    for (const auto& [name, value] : response.headers) to.set_header(name, value);
    if (!response.file.empty() && response.file_bytes > 0) return streamFile(response, to);
    if (response.status != 204) to.set_content(response.body, response.type);
  };
  server.set_pre_routing_handler([&station](const httplib::Request& from, httplib::Response& to) {
    ignoreRanges(from);
    const auto refused = station.refusal(requestOf(from));
    if (!refused) return httplib::Server::HandlerResponse::Unhandled;
    refuse(*refused, to);
    return httplib::Server::HandlerResponse::Handled;
  });
  server.set_error_handler(explainError);
  server.Get(".*", handle);
  server.Post(".*", handle);
  listenAt(server, address);
  server.widenBacklog();
  implementation_->thread = std::thread([&server] { server.listen_after_bind(); });
}

HttpServer::~HttpServer() {
  implementation_->server.end();
  implementation_->thread.join();
}

}  // namespace redbee
