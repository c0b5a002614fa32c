#include "redbee/node/heartbeat.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "processes/redbee/vehicle/heartbeat_receiver.hpp"
#include "redbee/files/user_error.hpp"
#include "redbee/node/unix_address.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee {
namespace {

class HeartbeatTest : public testing::Test {
 protected:
  HeartbeatTest() { setenv("NOTIFY_SOCKET", socket_.c_str(), 1); }
  ~HeartbeatTest() override { unsetenv("NOTIFY_SOCKET"); }

  test::ScratchFolder folder_;
  std::filesystem::path socket_ = folder_.path() / "notify.sock";
};

TEST_F(HeartbeatTest, ArrivesWithTheNumberOfItsSender) {
  HeartbeatReceiver receiver(socket_);
  const pid_t child = fork();
  if (child == 0) {
    Heartbeat().beat();
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  EXPECT_THAT(receiver.drain(), testing::ElementsAre(child));
  EXPECT_TRUE(receiver.drain().empty());
}

TEST_F(HeartbeatTest, IsSentOncePerPeriod) {
  HeartbeatReceiver receiver(socket_);
  Heartbeat heartbeat;
  for (int i = 0; i < 3; ++i) heartbeat.beat();
  EXPECT_LE(receiver.drain().size(), 2u);
}

TEST_F(HeartbeatTest, WithoutAReceiverNothingHappens) {
  Heartbeat heartbeat;
  heartbeat.beat();
  unsetenv("NOTIFY_SOCKET");
  Heartbeat().beat();
}

TEST_F(HeartbeatTest, ANewReceiverTakesOver) {
  std::optional<HeartbeatReceiver> first(std::in_place, socket_);
  HeartbeatReceiver second(socket_);
  first.reset();
  Heartbeat().beat();
  EXPECT_THAT(second.drain(), testing::ElementsAre(getpid()));
}

/// Receives as systemd does: a barrier's descriptor is closed once what came before it is handled.
class SlowReceiver {
 public:
  explicit SlowReceiver(const std::filesystem::path& path) : fd_(socket(AF_UNIX, SOCK_DGRAM, 0)) {
    const auto address = unixAddress(path.string());
    EXPECT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&*address), sizeof *address), 0);
  }
  ~SlowReceiver() { close(fd_); }

  std::string next() {
    char text[64] = {};
    iovec part{text, sizeof text};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))];
    msghdr header{};
    header.msg_iov = &part;
    header.msg_iovlen = 1;
    header.msg_control = control;
    header.msg_controllen = sizeof control;
    if (recvmsg(fd_, &header, MSG_DONTWAIT) < 0) return "";
    if (const cmsghdr* rights = CMSG_FIRSTHDR(&header))
      std::memcpy(&barrier_, CMSG_DATA(rights), sizeof(int));
    return text;
  }
  void passBarrier() const { close(barrier_); }

 private:
  int fd_;
  int barrier_ = -1;
};

TEST_F(HeartbeatTest, WhatMustArriveIsWaitedFor) {
  SlowReceiver receiver(socket_);
  Heartbeat heartbeat;
  for (int i = 0; i < 2000; ++i) heartbeat.send("WATCHDOG=1");  // until it takes no more
  std::vector<std::string> received;
  int waited = 0;
  bool was_passed = false;
  const bool is_taken = heartbeat.deliver("WATCHDOG_USEC=0", std::chrono::minutes(1), [&] {
    ++waited;
    if (waited == 1) return;  // the queue is full
    for (std::string text = receiver.next(); !text.empty(); text = receiver.next()) received.push_back(text);
    if (received.back() != "BARRIER=1") return;
    was_passed = true;
    receiver.passBarrier();
  });
  EXPECT_TRUE(is_taken);
  EXPECT_TRUE(was_passed) << "whose sender ends before, is not heard";
  ASSERT_GE(received.size(), 2U);
  EXPECT_EQ(received[received.size() - 2], "WATCHDOG_USEC=0");
}

TEST_F(HeartbeatTest, WhatNobodyTakesIsGivenUp) {
  const auto never = [] {};
  EXPECT_FALSE(Heartbeat().deliver("WATCHDOG_USEC=0", std::chrono::minutes(1), never)) << "no receiver";
  const SlowReceiver receiver(socket_);
  EXPECT_FALSE(Heartbeat().deliver("WATCHDOG_USEC=0", std::chrono::milliseconds(60), never));
  unsetenv("NOTIFY_SOCKET");
  EXPECT_FALSE(Heartbeat().deliver("WATCHDOG_USEC=0", std::chrono::minutes(1), never));
}

TEST_F(HeartbeatTest, ASocketThatCannotBeMadeIsNamed) {
  EXPECT_THROW(HeartbeatReceiver(folder_.path() / "none" / "notify.sock"), UserError);
  EXPECT_THROW(HeartbeatReceiver(folder_.path() / std::string(200, 'x')), UserError);
}

}  // namespace
}  // namespace redbee
