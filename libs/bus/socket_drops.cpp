#include "redbee/bus/socket_drops.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace redbee {
namespace {

std::set<uint64_t> ownSockets() {
  const std::string kind = "socket:[";
  std::set<uint64_t> inodes;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const std::string target = std::filesystem::read_symlink(entry.path(), error).string();
    if (error || target.rfind(kind, 0) != 0) continue;
    inodes.insert(std::stoull(target.substr(kind.size())));
  }
  return inodes;
}

}  // namespace

int64_t droppedPackets(std::istream& table, const std::set<uint64_t>& inodes) {
  // sl local remote st tx:rx tr:when retransmits uid timeout inode references pointer drops
  constexpr size_t kInode = 9;
  constexpr size_t kDrops = 12;
  int64_t dropped = 0;
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::vector<std::string> row;
    for (std::string field; fields >> field;) row.push_back(field);
    if (row.size() <= kDrops || inodes.count(std::stoull(row[kInode])) == 0) continue;
    dropped += std::stoll(row[kDrops]);
  }
  return dropped;
}

int64_t droppedPackets() {
  std::ifstream table("/proc/self/net/udp");
  return droppedPackets(table, ownSockets());
}

}  // namespace redbee
