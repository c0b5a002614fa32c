#include "processes/redbee/vehicle/supervisor_client.hpp"

#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "redbee/files/user_error.hpp"
#include "redbee/node/unix_address.hpp"

namespace redbee {
namespace {

constexpr suseconds_t kPatience_us = 300'000;
constexpr size_t kLongestResponse = size_t{1} << 20;

/// Closed at the end of the scope.
struct Connection {
  int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    if (fd >= 0) close(fd);
  }
};

bool connectTo(const Connection& connection, const std::string& path) {
  const auto address = unixAddress(path);
  if (connection.fd < 0 || !address) return false;
  const timeval patience{0, kPatience_us};
  setsockopt(connection.fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  setsockopt(connection.fd, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  return connect(connection.fd, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) == 0;
}

std::string receiveAll(const Connection& connection) {
  std::string response;
  char block[8192];
  while (response.size() < kLongestResponse) {
    const ssize_t count = recv(connection.fd, block, sizeof block, 0);
    if (count <= 0) break;
    response.append(block, static_cast<size_t>(count));
  }
  return response;
}

/// The text of a member's value in an XML-RPC struct: between its innermost tags.
std::string memberOf(const std::string& text, const std::string& name) {
  size_t at = text.find("<name>" + name + "</name>");
  if (at == std::string::npos) return "";
  at = text.find("<value>", at);
  if (at == std::string::npos) return "";
  const size_t first = text.find('>', at + std::strlen("<value>"));
  if (first == std::string::npos) return "";
  return text.substr(first + 1, text.find('<', first) - first - 1);
}

std::optional<SupervisedProcess> parseStruct(const std::string& text) {
  SupervisedProcess process;
  process.name = memberOf(text, "name");
  const std::string state = memberOf(text, "statename");
  process.is_up = state == "RUNNING" || state == "STARTING";
  const std::string pid = memberOf(text, "pid");
  const auto [end, error] = std::from_chars(pid.data(), pid.data() + pid.size(), process.pid);
  const bool is_number = error == std::errc() && end == pid.data() + pid.size();
  if (process.name.empty() || state.empty() || !is_number) return std::nullopt;
  return process;
}

}  // namespace

SupervisorClient SupervisorClient::ofParent() {
  const std::string scheme = "unix://";
  const char* url = std::getenv("SUPERVISOR_SERVER_URL");  // NOLINT(concurrency-mt-unsafe)
  if (url == nullptr || std::string(url).rfind(scheme, 0) != 0) {
    throw UserError("redbee watch: works only as a process of supervisor; start the stack with: fly up");
  }
  return SupervisorClient(std::string(url).substr(scheme.size()));
}

std::string SupervisorClient::call(const std::string& method, const std::string& parameters) const {
  const std::string body = "<?xml version=\"1.0\"?><methodCall><methodName>supervisor." + method +
                           "</methodName><params>" + parameters + "</params></methodCall>";
  const std::string request =
      "POST /RPC2 HTTP/1.0\r\nContent-Type: text/xml\r\nContent-Length: " + std::to_string(body.size()) +
      "\r\n\r\n" + body;
  const Connection connection;
  if (!connectTo(connection, socket_.string())) return "";
  if (send(connection.fd, request.data(), request.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(request.size()))
    return "";
  return receiveAll(connection);
}

std::optional<std::vector<SupervisedProcess>> SupervisorClient::processes() const {
  return parseProcessInfo(call("getAllProcessInfo", ""));
}

/// Without waiting until the process is up or has ended.
std::string SupervisorClient::actOnce(const std::string& method, const std::string& process) const {
  const std::string response =
      call(method, "<param><value><string>" + process +
                       "</string></value></param><param><value><boolean>0</boolean></value></param>");
  if (response.empty()) return "supervisor does not answer";
  if (response.find("<fault>") == std::string::npos) return "";
  const std::string fault = memberOf(response, "faultString");
  return "supervisor: " + (fault.empty() ? "a fault" : fault);
}

std::string SupervisorClient::act(const std::string& action, const std::string& process) const {
  if (action == "start") return actOnce("startProcess", process);
  if (action == "stop") return actOnce("stopProcess", process);
  if (action != "restart") return action + ": is no action";
  // What ends on a signal is started again, as after any end; supervisor's own stop would keep it away.
  const std::string signal = call(
      "signalProcess", "<param><value><string>" + process +
                           "</string></value></param><param><value><string>TERM</string></value></param>");
  if (signal.empty()) return "supervisor does not answer";
  if (signal.find("<fault>") == std::string::npos) return "";
  return actOnce("startProcess", process);  // it was stopped
}

std::optional<std::vector<SupervisedProcess>> parseProcessInfo(const std::string& response) {
  const std::string begin = "<struct>";
  const std::string end = "</struct>";
  if (response.find("</methodResponse>") == std::string::npos) return std::nullopt;
  if (response.find("<fault>") != std::string::npos) return std::nullopt;
  std::vector<SupervisedProcess> processes;
  for (size_t at = 0; (at = response.find(begin, at)) != std::string::npos;) {
    const size_t last = response.find(end, at);
    if (last == std::string::npos) return std::nullopt;
    const auto process = parseStruct(response.substr(at, last - at));
    if (!process) return std::nullopt;
    if (process->pid > 0) processes.push_back(*process);
    at = last;
  }
  return processes;
}

}  // namespace redbee
