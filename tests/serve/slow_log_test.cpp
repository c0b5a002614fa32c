// A log that takes long to be opened keeps nobody from another one.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <future>

#include "processes/serve/archive.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/new_file.hpp"
#include "tests/support/camera.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

constexpr std::chrono::seconds kLong{60};

void writeFlight(const fs::path& file, int frames) {
  LogWriter log(file);
  for (int k = 0; k < frames; ++k)
    log.write("CAMERA", rawGreyMessage(1'000'000'000 + k * 40'000, cv::Mat1b(kHeight, kWidth, uchar{90})));
  log.close();
}

TEST(SlowLog, KeepsNobodyFromAnother) {
  const ScratchFolder folder;
  fs::create_directories(folder / "flights");
  writeFlight(folder / "flights/slow.lcm", 2);
  writeFlight(folder / "flights/other.lcm", 3);
  // Who opens a file under a lease waits until it is given back; the signal that says so is not for us.
  std::signal(SIGIO, SIG_IGN);
  const FileDescriptor lease(open((folder / "flights/slow.lcm").c_str(), O_RDWR | O_CLOEXEC));
  if (fcntl(lease.get(), F_SETLEASE, F_WRLCK) != 0) GTEST_SKIP() << "no leases in this folder";
  Configuration configuration;
  configuration.camera = intrinsics();
  Archive archive(configuration, {folder / "flights"});
  const auto opening = [&](const char* name) {
    return std::async(std::launch::async, [&archive, name] { return archive.open(name, true)->frames(); });
  };
  auto slow = opening("flights/slow.lcm");
  auto second = opening("flights/slow.lcm");
  // F_GETLEASE says F_UNLCK as soon as somebody waits.
  while (fcntl(lease.get(), F_GETLEASE) == F_WRLCK) std::this_thread::yield();
  auto other = opening("flights/other.lcm");
  const bool is_read = other.wait_for(kLong) == std::future_status::ready;
  const bool is_slow = slow.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
  EXPECT_EQ(archive.flights().size(), 2U) << "the list needs no log";
  EXPECT_EQ(fcntl(lease.get(), F_SETLEASE, F_UNLCK), 0);
  EXPECT_TRUE(is_read && is_slow);
  EXPECT_EQ(other.get(), 3U);
  EXPECT_EQ(slow.get(), 2U);
  EXPECT_EQ(second.get(), 2U);
}

}  // namespace
}  // namespace redbee::test
