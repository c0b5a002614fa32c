#include "redbee/node/heartbeat.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>

#include "processes/redbee/vehicle/heartbeat_receiver.hpp"
#include "redbee/files/user_error.hpp"
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

TEST_F(HeartbeatTest, ASocketThatCannotBeMadeIsNamed) {
  EXPECT_THROW(HeartbeatReceiver(folder_.path() / "none" / "notify.sock"), UserError);
  EXPECT_THROW(HeartbeatReceiver(folder_.path() / std::string(200, 'x')), UserError);
}

}  // namespace
}  // namespace redbee
