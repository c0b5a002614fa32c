#include "redbee/files/split_log.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee {
namespace {

ReceivedMessage messageOf(int64_t utime, size_t size) {
  return {utime, "CAMERA", std::vector<uint8_t>(size, static_cast<uint8_t>(utime))};
}

std::vector<int64_t> timesIn(const std::filesystem::path& file) {
  std::vector<int64_t> times;
  LogReader reader(file);
  while (const auto event = reader.next()) {
    EXPECT_EQ(event->channel, "CAMERA");
    EXPECT_EQ(event->data.front(), static_cast<uint8_t>(event->utime));
    times.push_back(event->utime);
  }
  EXPECT_EQ(reader.damaged(), 0);
  return times;
}

TEST(SplitLog, EveryMessageIsInOneFileInOrder) {
  const test::ScratchFolder folder;
  SplitLog log(folder.path() / "f.lcm", 2500);
  for (int k = 0; k < 10; ++k) log.write(messageOf(k, 1000));
  log.sync();
  std::vector<int64_t> all;
  int files = 0;
  for (const char* name : {"f.lcm.0000", "f.lcm.0001", "f.lcm.0002", "f.lcm.0003"}) {
    const auto times = timesIn(folder.path() / name);
    EXPECT_LE(times.size(), 3u) << "three of a little over 1000 bytes exceed 2500";
    all.insert(all.end(), times.begin(), times.end());
    ++files;
  }
  EXPECT_EQ(all, (std::vector<int64_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(log.file(), folder.path() / "f.lcm.0003");
}

TEST(SplitLog, NeverTouchesAFileThatIsThere) {
  const test::ScratchFolder folder;
  std::ofstream(folder.path() / "f.lcm.0000") << "earlier";
  SplitLog log(folder.path() / "f.lcm", 1000000);
  log.write(messageOf(1, 10));
  log.sync();
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "f.lcm.0000"), 7u);
  EXPECT_EQ(timesIn(folder.path() / "f.lcm.0001"), std::vector<int64_t>{1});
}

// What the disk has free is told to the log, as other programs change it while the test runs.
TEST(SplitLog, AMessageThatWouldTakeFromTheReserveIsNotWritten) {
  const test::ScratchFolder folder;
  constexpr int64_t kReserve = int64_t{1} << 40;
  SplitLog log(folder.path() / "f.lcm", 1 << 30, kReserve, [](int) { return kReserve + (2 << 20); });
  log.write(messageOf(1, 1 << 20));
  EXPECT_THROW(log.write(messageOf(2, 2 << 20)), InputError);
  log.write(messageOf(3, 1 << 20));
  EXPECT_EQ(timesIn(folder.path() / "f.lcm.0000"), (std::vector<int64_t>{1, 3}));
}

TEST(SplitLog, ADiskThatHasLessThanTheReserveTakesNothing) {
  const test::ScratchFolder folder;
  SplitLog log(folder.path() / "f.lcm", 1 << 30, int64_t{1} << 62);
  EXPECT_THROW(log.write(messageOf(1, 1000)), InputError) << "no disk is of four exabytes";
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "f.lcm.0000"), 0u);
}

TEST(SplitLog, AnEventThatTheDiskTookHalfOfIsRemoved) {
  const test::ScratchFolder folder;
  SplitLog log(folder.path() / "f.lcm", 1 << 30);
  const test::FileSizeLimit full(2600);
  log.write(messageOf(1, 1000));
  log.write(messageOf(2, 1000));
  EXPECT_THROW(log.write(messageOf(3, 1000)), InputError);
  EXPECT_EQ(timesIn(folder.path() / "f.lcm.0000"), (std::vector<int64_t>{1, 2}));
  LogReader reader(folder.path() / "f.lcm.0000");
  while (reader.next()) {
  }
  EXPECT_FALSE(reader.truncated());
}

TEST(SplitLog, WritesThroughNoLink) {
  const test::ScratchFolder folder;
  std::filesystem::create_symlink(folder / "victim", folder / "f.lcm.0000");
  SplitLog log(folder.path() / "f.lcm", 1000000);
  log.write(messageOf(1, 10));
  EXPECT_FALSE(std::filesystem::exists(folder / "victim"));
  EXPECT_EQ(timesIn(folder / "f.lcm.0001"), std::vector<int64_t>{1});
}

TEST(SplitLog, WhatTheDiskDoesNotTakeIsAnError) {
  EXPECT_THROW(SplitLog("/no such folder/f.lcm", 1000), InputError);
}

}  // namespace
}  // namespace redbee
