#include "redbee/bus/socket_drops.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <sstream>
#include <vector>

namespace redbee {
namespace {

TEST(SocketDrops, CountsTheGivenSockets) {
  std::istringstream table(
      "   sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode ref "
      "pointer drops\n"
      "  101: 00000000:1DF3 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 4711 2 "
      "0000000000000000 12\n"
      "  101: 00000000:1DF3 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 4712 2 "
      "0000000000000000 500\n"
      "  102: 00000000:1DF4 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 4713 2 "
      "0000000000000000 7\n"
      "cut short 4711\n");
  EXPECT_EQ(droppedPackets(table, {4711, 4713}), 19);
}

TEST(SocketDrops, DroppedDatagramsAreCounted) {
  const int receiver = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* raw = reinterpret_cast<sockaddr*>(&address);
  socklen_t length = sizeof address;
  if (bind(receiver, raw, length) != 0) GTEST_SKIP() << "no loopback here";
  getsockname(receiver, raw, &length);
  const int small = 4096;
  setsockopt(receiver, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
  const int64_t before = droppedPackets();
  const int sender = socket(AF_INET, SOCK_DGRAM, 0);
  const std::vector<char> packet(1000);
  const int sent = 100;
  for (int i = 0; i < sent; ++i) sendto(sender, packet.data(), packet.size(), 0, raw, length);
  std::vector<char> into(2000);
  int kept = 0;
  while (recv(receiver, into.data(), into.size(), MSG_DONTWAIT) > 0) ++kept;
  EXPECT_LT(kept, sent);
  EXPECT_EQ(droppedPackets() - before, sent - kept);
  close(receiver);
  close(sender);
}

}  // namespace
}  // namespace redbee
