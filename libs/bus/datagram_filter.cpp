#include "redbee/bus/datagram_filter.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>

namespace redbee {
namespace {

// Offsets from the UDP header, which is where the kernel lets a program begin. LCM's headers, big-endian:
// magic, sequence number, then the channel; of a fragment the message's size, the fragment's offset and its
// number stand between.
constexpr uint32_t kMagic = 8;
constexpr uint32_t kChannel = 16;
constexpr uint32_t kMessageSize = 16;
constexpr uint32_t kFragment = 24;
constexpr uint32_t kChannelOfFirst = 28;
constexpr uint32_t kWholeMessage = 0x4c433032;  // LC02
constexpr uint32_t kFragmentOf = 0x4c433033;    // LC03
constexpr uint32_t kKeep = 0xffffffff;          // bytes
constexpr uint32_t kDrop = 0;
constexpr size_t kMostChannels = 64;  // far below the longest program that the kernel takes

sock_filter operation(int code, uint32_t k) { return BPF_STMT(static_cast<uint16_t>(code), k); }
/// Skips so many operations.
sock_filter jump(int test, uint32_t k, size_t if_true, size_t if_false) {
  return BPF_JUMP(static_cast<uint16_t>(BPF_JMP | BPF_K | test), k, static_cast<uint8_t>(if_true),
                  static_cast<uint8_t>(if_false));
}
sock_filter end(uint32_t bytes) { return operation(BPF_RET | BPF_K, bytes); }

/// Ends with kKeep where the name stands at X, with its zero; else goes on behind.
std::vector<sock_filter> comparison(const std::string& channel) {
  const size_t length = channel.size() + 1;
  std::vector<sock_filter> result;
  std::vector<size_t> tests;
  const auto demand = [&](int test, uint32_t k) {
    tests.push_back(result.size());
    result.push_back(jump(test, k, 0, 0));
  };
  result.push_back(operation(BPF_LD | BPF_W | BPF_LEN, 0));
  result.push_back(operation(BPF_ALU | BPF_SUB | BPF_X, 0));
  demand(BPF_JGE, static_cast<uint32_t>(length));
  for (size_t i = 0; i < length;) {
    const size_t bytes = length - i >= 4 ? 4 : length - i >= 2 ? 2 : 1;
    uint32_t value = 0;
    for (size_t k = i; k < i + bytes; ++k) value = value << 8 | static_cast<uint8_t>(channel.c_str()[k]);
    const int size = bytes == 4 ? BPF_W : bytes == 2 ? BPF_H : BPF_B;
    result.push_back(operation(BPF_LD | size | BPF_IND, static_cast<uint32_t>(i)));
    demand(BPF_JEQ, value);
    i += bytes;
  }
  result.push_back(end(kKeep));
  for (const size_t test : tests) result[test].jf = static_cast<uint8_t>(result.size() - test - 1);
  return result;
}

}  // namespace

std::vector<sock_filter> datagramFilter(const std::vector<WantedChannel>& wanted) {
  const bool all_short =
      std::all_of(wanted.begin(), wanted.end(), [](const WantedChannel& each) { return each.is_short; });
  std::vector<sock_filter> program{
      operation(BPF_LD | BPF_W | BPF_ABS, kMagic),
      jump(BPF_JEQ, kWholeMessage, 8, 0),
      jump(BPF_JEQ, kFragmentOf, 1, 0),
      end(kKeep),  // not LCM's
      operation(BPF_LD | BPF_H | BPF_ABS, kFragment),
      jump(BPF_JEQ, 0, 6, 0),
      operation(BPF_LD | BPF_W | BPF_ABS, kMessageSize),
      jump(BPF_JGT, all_short ? kShortMessage : kKeep, 0, 1),
      end(kDrop),
      end(kKeep),
      operation(BPF_LDX | BPF_IMM, kChannel),  // a whole message
      operation(BPF_JMP | BPF_JA, 1),
      operation(BPF_LDX | BPF_IMM, kChannelOfFirst),
  };
  for (const WantedChannel& each : wanted) {
    const auto part = comparison(each.name);
    program.insert(program.end(), part.begin(), part.end());
  }
  program.push_back(end(kDrop));
  return program;
}

bool receiveOnly(int socket, const std::vector<WantedChannel>& wanted) {
  if (wanted.size() <= kMostChannels) {
    std::vector<sock_filter> program = datagramFilter(wanted);
    const sock_fprog filter{static_cast<uint16_t>(program.size()), program.data()};
    if (setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) == 0) return true;
  }
  // The kernel has no memory for it (net.core.optmem_max): the one before would drop what is wanted now.
  int unused = 0;
  setsockopt(socket, SOL_SOCKET, SO_DETACH_FILTER, &unused, sizeof unused);
  return false;
}

std::set<int> udpSockets() {
  std::set<int> sockets;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const int fd = std::stoi(entry.path().filename().string());
    int type = 0;
    socklen_t size = sizeof type;
    if (getsockopt(fd, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) continue;
    int domain = 0;
    size = sizeof domain;
    if (getsockopt(fd, SOL_SOCKET, SO_DOMAIN, &domain, &size) == 0 && domain == AF_INET) sockets.insert(fd);
  }
  return sockets;
}

}  // namespace redbee
