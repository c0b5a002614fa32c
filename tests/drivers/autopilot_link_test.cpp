// The links of redbee-autopilot on a pseudo-terminal and on the loopback, and the file of its key.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "processes/link/link.hpp"
#include "processes/link/signing_key.hpp"
#include "redbee/files/new_file.hpp"
#include "redbee/files/user_error.hpp"
#include "redbee/mavlink/encoder.hpp"
#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/peer_check.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

using Kind = mavlink::LinkAddress::Kind;
using Bytes = std::vector<uint8_t>;
constexpr std::chrono::milliseconds kLong{5000};

TEST(AutopilotSerialLink, PassesEveryByteBothWays) {
  const FileDescriptor master(posix_openpt(O_RDWR | O_NOCTTY));
  ASSERT_TRUE(master.isOpen() && grantpt(master.get()) == 0 && unlockpt(master.get()) == 0);
  const auto link = makeLink({Kind::kSerial, ptsname(master.get()), 921600});
  ASSERT_EQ(link->open(), "");
  Bytes all(256);
  for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<uint8_t>(i);
  ASSERT_EQ(write(master.get(), all.data(), all.size()), 256);
  Bytes received;
  while (received.size() < all.size()) {
    const ReceivedBytes part = link->receive(kLong);
    ASSERT_FALSE(part.data.empty());
    received.insert(received.end(), part.data.begin(), part.data.end());
  }
  EXPECT_EQ(received, all);
  ASSERT_TRUE(link->send(all));
  Bytes sent(256);
  size_t size = 0;
  while (size < sent.size()) {
    const ssize_t part = read(master.get(), sent.data() + size, sent.size() - size);
    ASSERT_GT(part, 0);
    size += static_cast<size_t>(part);
  }
  EXPECT_EQ(sent, all);
}

TEST(AutopilotSerialLink, ClosesWhenTheDeviceGoes) {
  FileDescriptor master(posix_openpt(O_RDWR | O_NOCTTY));
  ASSERT_TRUE(master.isOpen() && grantpt(master.get()) == 0 && unlockpt(master.get()) == 0);
  const auto link = makeLink({Kind::kSerial, ptsname(master.get()), 57600});
  ASSERT_EQ(link->open(), "");
  master = FileDescriptor();
  link->receive(kLong);
  EXPECT_FALSE(link->isOpen());
  EXPECT_NE(link->open(), "");
}

TEST(AutopilotSerialLink, SaysWhatIsWrong) {
  EXPECT_EQ(makeLink({Kind::kSerial, "/dev/not_there", 57600})->open(),
            "/dev/not_there: No such file or directory");
  EXPECT_EQ(makeLink({Kind::kSerial, "/dev/null", 57600})->open(), "/dev/null: is no serial port");
  EXPECT_THROW(makeLink({Kind::kSerial, "/dev/ttyACM0", 12345}), UserError);
}

/// A socket of the loopback with a port of its own.
struct Peer {
  FileDescriptor socket{::socket(AF_INET, SOCK_DGRAM, 0)};
  sockaddr_in address{};
  Peer() {
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(bind(socket.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    socklen_t length = sizeof address;
    getsockname(socket.get(), reinterpret_cast<sockaddr*>(&address), &length);
  }
  uint16_t port() const { return ntohs(address.sin_port); }
  void sendTo(uint16_t to_port, const Bytes& data) const {
    sockaddr_in to = address;
    to.sin_port = htons(to_port);
    EXPECT_EQ(sendto(socket.get(), data.data(), data.size(), 0, reinterpret_cast<sockaddr*>(&to), sizeof to),
              static_cast<ssize_t>(data.size()));
  }
  Bytes receive() const {
    Bytes buffer(100);
    buffer.resize(
        static_cast<size_t>(std::max<ssize_t>(recv(socket.get(), buffer.data(), buffer.size(), 0), 0)));
    return buffer;
  }
};

TEST(AutopilotUdpLink, ListensToTheFirstThatSpeaks) {
  uint16_t port = 0;
  {
    port = Peer().port();  // free again
  }
  const auto link = makeLink({Kind::kUdpListen, "127.0.0.1", port});
  ASSERT_EQ(link->open(), "");
  EXPECT_TRUE(link->send({1})) << "to nobody yet";
  const Peer first;
  const Peer second;
  first.sendTo(port, {1, 2, 3});
  EXPECT_EQ(link->receive(kLong).data, (Bytes{1, 2, 3}));
  second.sendTo(port, {9});
  EXPECT_TRUE(link->receive(kLong).data.empty());
  EXPECT_TRUE(link->send({7}));
  EXPECT_EQ(first.receive(), Bytes{7});
}

TEST(AutopilotUdpLink, HasThePeerThatSendsFramesOfTheConfiguredSystem) {
  uint16_t port = 0;
  {
    port = Peer().port();  // free again
  }
  const mavlink::SigningKey key{1, 2, 3};
  for (const bool has_key : {false, true}) {
    const auto wanted = has_key ? std::optional(key) : std::nullopt;
    const auto link = makeLink({Kind::kUdpListen, "127.0.0.1", port}, [&](const Bytes& datagram) {
      return mavlink::holdsFrameOf(datagram, uint8_t{7}, wanted);
    });
    ASSERT_EQ(link->open(), "");
    const Peer stranger, other, vehicle;
    mavlink::Encoder of_other(8, 1), of_vehicle(7, 1);
    if (has_key) of_vehicle.signWith(mavlink::Signer(key, 0, 1));
    const auto heartbeat = of_vehicle.encode(mavlink::Heartbeat{});
    auto damaged = heartbeat;
    damaged[12] ^= 1;
    stranger.sendTo(port, {1, 2, 3});
    stranger.sendTo(port, damaged);
    other.sendTo(port, of_other.encode(mavlink::Heartbeat{}));
    if (has_key) other.sendTo(port, mavlink::Encoder(7, 1).encode(mavlink::Heartbeat{}));
    for (int i = 0; i < (has_key ? 4 : 3); ++i) EXPECT_TRUE(link->receive(kLong).data.empty()) << i;
    vehicle.sendTo(port, heartbeat);
    EXPECT_EQ(link->receive(kLong).data, heartbeat);
    ASSERT_TRUE(link->send({7}));
    EXPECT_EQ(vehicle.receive(), Bytes{7});
  }
}

TEST(AutopilotUdpLink, SpeaksFirst) {
  const Peer autopilot;
  const auto link = makeLink({Kind::kUdpSend, "127.0.0.1", autopilot.port()});
  ASSERT_EQ(link->open(), "");
  EXPECT_TRUE(link->send({1}));
  EXPECT_EQ(autopilot.receive(), Bytes{1});
}

TEST(AutopilotUdpLink, SaysThatItsPortIsTaken) {
  const Peer other;
  EXPECT_THAT(makeLink({Kind::kUdpListen, "127.0.0.1", other.port()})->open(),
              testing::HasSubstr("already in use"));
}

TEST(AutopilotKey, IsAFileThatOthersMayNotRead) {
  const ScratchFolder folder;
  const auto file = folder.path() / "key";
  EXPECT_FALSE(readSigningKey(""));
  EXPECT_THROW(readSigningKey(file), UserError);
  std::ofstream(file) << std::string(64, 'a') << "\n";
  std::filesystem::permissions(file, std::filesystem::perms(0644));
  EXPECT_THROW(readSigningKey(file), UserError);
  std::filesystem::permissions(file, std::filesystem::perms(0640));
  ASSERT_TRUE(readSigningKey(file));
  EXPECT_EQ((*readSigningKey(file))[31], 0xaa);
  std::ofstream(file) << std::string(63, 'a') << "\n";
  EXPECT_THROW(readSigningKey(file), UserError);
}

}  // namespace
}  // namespace redbee::test
