// stranger: what another user of the host may send, and hear, where the stack's network is open. For
// tests/integration.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <random>
#include <stdexcept>

#include "processes/common_options.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/process_health_t.hpp"
#include "tests/support/forgery.hpp"

namespace redbee::test {
namespace {

using Clock = std::chrono::steady_clock;

/// PROCESS_HEALTH in the name of others.
struct Forgery {
  int pid = 0;
  std::vector<std::string> processes;
  int invented = 0;  ///< further names, each once

  void send(Bus& bus) const {
    process_health_t health{};
    health.pid = pid;
    health.state = process_health_t::GOOD;
    health.configuration = "cafe";
    for (const std::string& process : processes) {
      health.process = process;
      bus.publish(Channels().health, health);
    }
    health.lost = 9'000'000'000'000'000'000;
    for (int i = 0; i < invented; ++i) {
      health.process = "invented-" + std::to_string(i);
      bus.publish(Channels().health, health);
      if (i % 50 == 0) usleep(5000);  // no faster than they are received
    }
  }
};

/// Packets that lcm_udpm.c of LCM 1.3.1 does not survive.
class Packets {
 public:
  explicit Packets(const std::string& url) : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
    std::array<char, 64> group{};
    int port = 0;
    if (std::sscanf(url.c_str(), "udpm://%63[0-9.]:%d", group.data(), &port) != 2)
      throw std::runtime_error(url + ": no udpm://GROUP:PORT");
    address_.sin_family = AF_INET;
    address_.sin_port = htons(static_cast<uint16_t>(port));
    inet_pton(AF_INET, group.data(), &address_.sin_addr);
  }
  ~Packets() { close(socket_); }
  Packets(const Packets&) = delete;
  Packets& operator=(const Packets&) = delete;

  /// One without a channel: LCM hands it out with a size of -1. Whoever subscribes to all channels receives
  /// it.
  void sendShort() const { sendWords({kWhole, 8}, nullptr, 0); }

  void send() const {
    constexpr uint32_t kFragment = 0x4c433033;
    constexpr uint32_t kSize = 4000;
    // A fragment whose offset wraps round, behind a normal first one.
    sendWords({kFragment, 7, kSize, 0, 2}, "CAMERA", 1000);
    sendWords({kFragment, 7, kSize, 0xfffffff6, 0x00010002}, "", 1000);
    sendShort();
    // One fragment of 255 MB.
    sendWords({kFragment, 9, 255u << 20, 0, 2}, "PROCESS_HEALTH", 1000);
  }

 private:
  static constexpr uint32_t kWhole = 0x4c433032;

  void sendWords(const std::vector<uint32_t>& words, const char* channel, size_t bytes) const {
    std::vector<char> packet;
    for (const uint32_t word : words) {
      const uint32_t wire = htonl(word);
      const auto* first = reinterpret_cast<const char*>(&wire);
      packet.insert(packet.end(), first, first + sizeof wire);
    }
    if (channel != nullptr && channel[0] != '\0')
      packet.insert(packet.end(), channel, channel + std::strlen(channel) + 1);
    packet.insert(packet.end(), bytes, '\x55');
    sendto(socket_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&address_),
           sizeof address_);
  }

  int socket_;
  sockaddr_in address_{};
};

/// Random bytes on every channel.
void flood(Bus& bus, double seconds_long) {
  std::mt19937 random(1);
  const auto end = Clock::now() + std::chrono::duration<double>(seconds_long);
  int64_t messages = 0;
  while (Clock::now() < end) messages += sendRandomBytes(bus, random);
  std::printf("%.0f messages a second\n", static_cast<double>(messages) / seconds_long);
}

int heard(const std::string& url, double seconds_long) {
  const auto bus = makeLcmBus(url);
  int messages = 0;
  const Subscription subscription =
      bus->subscribe(Channels().health, kListenerQueue, [&](const uint8_t*, int) { ++messages; });
  const auto end = Clock::now() + std::chrono::duration<double>(seconds_long);
  while (Clock::now() < end) bus->handle(std::chrono::milliseconds(50));
  return messages;
}

}  // namespace
}  // namespace redbee::test

// For tests: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  using namespace redbee::test;
  CLI::App app("sends and hears what another user of the host may");
  app.require_subcommand(1);
  std::string url;
  redbee::addLcmUrlOption(app, url);
  Forgery forgery;
  double seconds_long = 2;
  auto* health = app.add_subcommand("health", "forged PROCESS_HEALTH");
  health->add_option("--pid", forgery.pid)->required();
  health->add_option("--process", forgery.processes);
  health->add_option("--invented", forgery.invented);
  auto* packets = app.add_subcommand("packets", "packets that end a program of LCM 1.3.1");
  auto* only_short = packets->add_flag("--short", "only one that LCM survives: no channel, a size of -1");
  auto* random = app.add_subcommand("flood", "random bytes on every channel");
  random->add_option("--seconds", seconds_long);
  auto* listen = app.add_subcommand("listen", "prints how many health messages are heard");
  listen->add_option("--seconds", seconds_long);
  CLI11_PARSE(app, argc, argv);
  if (*health) forgery.send(*redbee::makeLcmBus(url));
  if (*packets && *only_short) {
    Packets(url).sendShort();
  } else if (*packets) {
    Packets(url).send();
  }
  if (*random) flood(*redbee::makeLcmBus(url), seconds_long);
  if (*listen) std::printf("%d\n", heard(url, seconds_long));
  return 0;
}
