#include "processes/redbee/vehicle/stack_network.hpp"

#include <fcntl.h>
#include <net/if.h>
#include <sched.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <vector>

namespace redbee {
namespace {

namespace fs = std::filesystem;

struct NamespaceNumber {
  dev_t device;
  ino_t inode;
  bool operator==(const NamespaceNumber& other) const {
    return device == other.device && inode == other.inode;
  }
};

std::string networkFile(const std::string& process) { return "/proc/" + process + "/ns/net"; }

/// std::nullopt without the right to see it.
std::optional<NamespaceNumber> networkOf(const std::string& process) {
  struct stat status {};
  if (stat(networkFile(process).c_str(), &status) != 0) return std::nullopt;
  return NamespaceNumber{status.st_dev, status.st_ino};
}

bool hasOnlyLoopback() {
  using Interface = struct if_nameindex;  // a function has the same name
  const std::unique_ptr<Interface, void (*)(Interface*)> interfaces(if_nameindex(), if_freenameindex);
  if (!interfaces) return false;
  for (const Interface* entry = interfaces.get(); entry->if_index != 0; ++entry) {
    if (std::string(entry->if_name) != "lo") return false;
  }
  return true;
}

std::optional<pid_t> readPid(const fs::path& file) {
  std::ifstream stream(file);
  pid_t pid = 0;
  if (!(stream >> pid) || pid <= 1) return std::nullopt;
  const bool exists = kill(pid, 0) == 0 || errno == EPERM;
  return exists ? std::optional<pid_t>(pid) : std::nullopt;
}

NetworkOwner ownerOf(const std::optional<NamespaceNumber>& network, bool is_ours) {
  const auto host = networkOf("1");
  if (network && host) return *network == *host ? NetworkOwner::kHost : NetworkOwner::kStack;
  // Without root: a network with another interface than the loopback is the host's, or as good as.
  return is_ours && !hasOnlyLoopback() ? NetworkOwner::kHost : NetworkOwner::kUnknown;
}

}  // namespace

fs::path supervisorPidFile() {
  std::vector<fs::path> folders;
  const auto add = [&](const char* variable, const fs::path& below) {
    const char* value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe)
    if (value != nullptr && value[0] != '\0') folders.push_back(fs::path(value) / below);
  };
  add("REDBEE_RUN", "");
  folders.emplace_back("/run/redbee");
  add("XDG_RUNTIME_DIR", "redbee");
  folders.emplace_back("out/redbee");
  for (const fs::path& folder : folders) {
    if (readPid(folder / "supervisord.pid")) return folder / "supervisord.pid";
  }
  return folders.front() / "supervisord.pid";
}

StackNetwork stackNetwork(const fs::path& pid_file) {
  StackNetwork result;
  result.supervisor = readPid(pid_file);
  const auto own = networkOf("self");
  const auto network = result.supervisor ? networkOf(std::to_string(*result.supervisor)) : own;
  result.is_ours = own && network && *own == *network;
  result.owner = ownerOf(network, result.is_ours);
  return result;
}

bool enterNetworkOf(pid_t pid) {
  const int fd = open(networkFile(std::to_string(pid)).c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return false;
  const bool entered = setns(fd, CLONE_NEWNET) == 0;
  close(fd);
  return entered;
}

Finding findNetwork(const StackNetwork& network, bool is_inside) {
  const std::string who =
      network.supervisor ? "the stack (supervisor is process " + std::to_string(*network.supervisor) + ")"
                         : "a stack started here without root";
  const std::string own = "systemctl start redbee, or as root scripts/fly up, gives it a network of its own";
  switch (network.owner) {
    case NetworkOwner::kStack:
      if (is_inside)
        return {true, "network: its own, which no other user of this host can hear or send to", ""};
      return {false, "network: " + who + " has its own, and what follows is about another",
              "as root: scripts/fly inside redbee doctor"};
    case NetworkOwner::kHost:
      if (network.only_sender) {
        return {true,
                "network: " + who + " shares the host's, and nftables keep every user but " +
                    *network.only_sender + " from sending to it; all can hear it",
                ""};
      }
      return {false,
              "network: " + who +
                  " shares the host's: every user of this host can hear it, and end it by a packet",
              own + "; or a rule of nftables keeps others from sending: SECURITY.md"};
    case NetworkOwner::kUnknown:
      break;
  }
  return {false, "network: only root can tell whether other users of this host hear " + who,
          "as root: redbee doctor"};
}

}  // namespace redbee
