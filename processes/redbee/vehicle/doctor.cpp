#include "processes/redbee/vehicle/doctor.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "processes/redbee/vehicle/live_check.hpp"
#include "processes/redbee/vehicle/live_findings.hpp"
#include "processes/redbee/vehicle/sender_rule.hpp"
#include "processes/redbee/vehicle/stack_network.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/bus/receive_buffer.hpp"
#include "redbee/files/user_error.hpp"

namespace redbee {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kTestPoll = std::chrono::milliseconds(20);
constexpr const char* kProbeChannel = "REDBEE_DOCTOR";

template <typename Done>
void handleUntil(Bus& bus, double seconds, const Done& done) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (!done() && Clock::now() < end) bus.handle(kTestPoll);
}

bool onPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::error_code error;  // the path may name folders that we may not look into
    if (std::filesystem::exists(std::filesystem::path(folder) / program, error)) return true;
  }
  return false;
}

Finding sensorFinding(const std::string& channel, int count, double seconds) {
  if (count > 0) return {true, fmt::format("{}: {:.1f} messages per second", channel, count / seconds), ""};
  return {false, channel + ": no messages",
          "start the driver that publishes " + channel +
              " (or lcm-logplayer with a recorded flight) on the same URL"};
}

}  // namespace

Finding findReceiveBuffer(const std::string& url) {
  const UdpBufferCheck check = checkReceiveBuffer(url);
  if (check.enough) return {true, "receive buffer: the kernel grants the requested size", ""};
  return {false, "receive buffer: too small for images", check.advice};
}

Finding findMulticast(const std::string& url) {
  const std::string fix = "ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo";
  try {
    const auto sender = makeLcmBus(url);
    const auto receiver = makeLcmBus(url);
    bool received = false;
    const Subscription subscription = receiver->subscribe<altimeter_t>(
        kProbeChannel, 4, [&](const altimeter_t&) { received = true; }, nullptr);
    altimeter_t probe{};
    handleUntil(*receiver, 0.05, [] { return false; });
    sender->publish(kProbeChannel, probe);
    handleUntil(*receiver, 1.0, [&] { return received; });
    if (received) return {true, "multicast: a message to this program itself arrives", ""};
  } catch (const std::exception& error) {
    return {false, std::string("multicast: ") + error.what(), fix};
  }
  return {false, "multicast: a message to this program itself does not arrive", fix};
}

Finding findSpy() {
  std::string missing;
  if (!onPath("java")) missing += " default-jre";
  if (!std::filesystem::exists("/usr/share/java/lcm.jar")) missing += " liblcm-java";
  if (!std::filesystem::exists("/usr/share/java/jchart2d.jar")) missing += " libjchart2d-java";
  if (missing.empty()) return {true, "lcm-spy: Java and its libraries are installed", ""};
  return {false, "lcm-spy: missing" + missing, "apt-get install" + missing};
}

std::vector<Finding> findSensors(const DoctorOptions& options) {
  int camera = 0;
  int imu = 0;
  try {
    const auto bus = makeLcmBus(options.url);
    const Subscription camera_subscription =
        bus->subscribe(options.camera_channel, 100, [&](const uint8_t*, int) { ++camera; });
    const Subscription imu_subscription =
        bus->subscribe(options.imu_channel, 4000, [&](const uint8_t*, int) { ++imu; });
    handleUntil(*bus, options.listen_s, [] { return false; });
  } catch (const std::exception& error) {
    return {{false, std::string("sensors: ") + error.what(), "see multicast"}};
  }
  return {sensorFinding(options.camera_channel, camera, options.listen_s),
          sensorFinding(options.imu_channel, imu, options.listen_s)};
}

namespace {

int print(const std::vector<Finding>& findings) {
  int failed = 0;
  for (const Finding& finding : findings) {
    const char* mark = finding.good ? " ok " : "FAIL";
    std::printf("[%s] %s\n", finding.checked ? mark : " -- ", finding.what.c_str());
    if (!finding.fix.empty()) std::printf("       %s\n", finding.fix.c_str());
    failed += finding.good ? 0 : 1;
  }
  return failed;
}

/// Whether the network of the stack that is up is this process's, or root has entered it.
bool enterStack(StackNetwork& network) {
  return network.is_ours || (network.supervisor && enterNetworkOf(*network.supervisor));
}

}  // namespace

int runDoctor(const DoctorOptions& options) {
  StackNetwork network = stackNetwork(supervisorPidFile());
  const bool is_inside = enterStack(network);
  if (const auto port = portOf(options.url); port && is_inside) {
    network.only_sender = onlySender(readRuleset(), *port);
  }
  std::vector<Finding> findings = {findNetwork(network, is_inside), findReceiveBuffer(options.url),
                                   findMulticast(options.url), findSpy()};
  for (Finding& finding : findSensors(options)) findings.push_back(std::move(finding));
  return print(findings);
}

int runLiveDoctor(const LiveDoctorOptions& options) {
  const Configuration configuration = loadConfiguration(options.configuration);
  StackNetwork network = stackNetwork(supervisorPidFile());
  const bool is_inside = enterStack(network);
  const auto bus = makeLcmBus(options.url);
  LiveCheck check(*bus, configuration);
  handleUntil(*bus, options.listen_s, [] { return false; });
  if (!check.hasHeard()) {
    throw UserError(
        fmt::format("doctor: {}: nothing was heard in {} s; start the stack (scripts/fly up --config "
                    "{}){}",
                    options.url, options.listen_s, options.configuration.string(),
                    is_inside ? "" : ", or as root: it has a network of its own"));
  }
  std::vector<Finding> findings = check.findings();
  findings.push_back(findDisk(options.recordings, static_cast<double>(check.bytes()) / options.listen_s));
  const int failed = print(findings);
  const auto unchecked =
      std::count_if(findings.begin(), findings.end(), [](const Finding& f) { return !f.checked; });
  std::printf("%d failed, %d not checked, of %d\n", failed, static_cast<int>(unchecked),
              static_cast<int>(findings.size()));
  return failed;
}

}  // namespace redbee
