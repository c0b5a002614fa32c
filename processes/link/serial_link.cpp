#include "processes/link/serial_link.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "redbee/files/user_error.hpp"
#include "redbee/node/host_clock.hpp"

namespace redbee {
namespace {

constexpr std::array<std::pair<uint32_t, speed_t>, 14> kSpeeds{{{9600, B9600},
                                                                {19200, B19200},
                                                                {38400, B38400},
                                                                {57600, B57600},
                                                                {115200, B115200},
                                                                {230400, B230400},
                                                                {460800, B460800},
                                                                {500000, B500000},
                                                                {921600, B921600},
                                                                {1000000, B1000000},
                                                                {1500000, B1500000},
                                                                {2000000, B2000000},
                                                                {3000000, B3000000},
                                                                {4000000, B4000000}}};

speed_t speedOf(uint32_t baud) {
  const auto* const found =
      std::find_if(kSpeeds.begin(), kSpeeds.end(), [&](const auto& speed) { return speed.first == baud; });
  if (found != kSpeeds.end()) return found->second;
  std::string known;
  for (const auto& [each, speed] : kSpeeds) known += (known.empty() ? "" : ", ") + std::to_string(each);
  throw UserError("autopilot.link: a serial port has no speed of " + std::to_string(baud) + "; take one of " +
                  known);
}

std::string faultOfErrno(const std::string& what) { return what + ": " + std::strerror(errno); }

}  // namespace

SerialLink::SerialLink(std::string device, uint32_t baud)
    : device_(std::move(device)), speed_(speedOf(baud)) {}

std::string SerialLink::open() {
  // Without O_NONBLOCK a port waits for its carrier.
  FileDescriptor file(::open(device_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!file.isOpen()) return faultOfErrno(device_);
  termios settings{};
  if (tcgetattr(file.get(), &settings) != 0) return device_ + ": is no serial port";
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  if (cfsetspeed(&settings, speed_) != 0 || tcsetattr(file.get(), TCSANOW, &settings) != 0) {
    return faultOfErrno(device_);
  }
  ioctl(file.get(), TIOCEXCL);  // a second reader would take every other byte
  tcflush(file.get(), TCIFLUSH);
  file_ = std::move(file);
  return "";
}

ReceivedBytes SerialLink::receive(std::chrono::milliseconds timeout) {
  pollfd wait{file_.get(), POLLIN, 0};
  const int ready = poll(&wait, 1, static_cast<int>(timeout.count()));
  ReceivedBytes received;
  if (ready <= 0) return received;
  std::array<uint8_t, 4096> buffer;
  const ssize_t size = read(file_.get(), buffer.data(), buffer.size());
  received.host_ns = hostNanoseconds();
  if (size > 0) {
    received.data.assign(buffer.begin(), buffer.begin() + size);
  } else if (size == 0 || (errno != EAGAIN && errno != EINTR)) {
    file_ = FileDescriptor();  // unplugged
  }
  return received;
}

bool SerialLink::send(const std::vector<uint8_t>& data) {
  return write(file_.get(), data.data(), data.size()) == static_cast<ssize_t>(data.size());
}

}  // namespace redbee
