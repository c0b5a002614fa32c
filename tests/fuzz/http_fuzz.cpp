// What anybody who reaches redbee-serve's port may send: bytes, over a connection. The server answers with
// HTTP or ends the connection, and answers the next one.
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>

#include "processes/serve/http_server.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/fuzz/small_vehicle.hpp"

namespace redbee::fuzz {
namespace {

constexpr time_t kPatience_s = 18;  ///< libFuzzer has 20

/// libFuzzer's own alarm, twice in what it has patience for, interrupts a wait: that is no silence of the
/// server.
ssize_t receive(int descriptor, char* to, size_t size) {
  ssize_t read = 0;
  do {
    read = recv(descriptor, to, size, 0);
  } while (read < 0 && errno == EINTR);
  return read;
}

/// All that comes back.
std::string answerTo(const std::string& socket_file, const uint8_t* data, size_t size) {
  const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  socket_file.copy(address.sun_path, sizeof address.sun_path - 1);
  const timeval patience{kPatience_s, 0};
  setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  setsockopt(descriptor, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  if (connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) __builtin_trap();
  // The server may end the connection before it has read all.
  send(descriptor, data, size, MSG_NOSIGNAL);
  shutdown(descriptor, SHUT_WR);
  std::string answer;
  char part[65536];
  ssize_t read = 0;
  while ((read = receive(descriptor, part, sizeof part)) > 0) answer.append(part, static_cast<size_t>(read));
  if (read < 0 && errno != ECONNRESET) __builtin_trap();  // it neither answers nor ends the connection
  close(descriptor);
  return answer;
}

}  // namespace
}  // namespace redbee::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const fuzz::Folder folder;
  static const auto report = folder.write("flights/report.html", "<html></html>");
  static const std::string socket_file = (folder / "serve.sock").string();
  static const ListenAddress address = *listenAddressOf("unix:" + socket_file);
  static Live live;
  static Archive archive(fuzz::smallVehicle(), {folder / "flights"});
  static const StackControl control{[] { return std::optional<bool>(); },
                                    [](const std::string&, const std::string&) { return std::string(); }};
  static Station station(Access(address, "", true), archive, live, control);
  static const HttpServer server(address, station, live);
  const std::string answer = fuzz::answerTo(socket_file, data, size);
  if (!answer.empty() && answer.compare(0, 9, "HTTP/1.1 ") != 0) __builtin_trap();
  return 0;
}
