#include "redbee/files/log.hpp"

#include <lcm/eventlog.h>

#include <numeric>

#include "redbee/files/progress.hpp"
#include "redbee/ins_t.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

std::vector<uint8_t> payload(int size, int seed) {
  std::vector<uint8_t> data(static_cast<size_t>(size));
  std::iota(data.begin(), data.end(), static_cast<uint8_t>(seed));
  return data;
}

/// Ten events of 100 + k bytes on channel "A"; the offset of each, and the file's end.
std::vector<int64_t> writeTen(const fs::path& path) {
  LogWriter writer(path);
  std::vector<int64_t> offsets;
  for (int k = 0; k < 10; ++k) {
    offsets.push_back(writer.bytes());
    writer.write(1000 * k, "A", payload(100 + k, k));
  }
  offsets.push_back(writer.bytes());
  writer.close();
  return offsets;
}

void overwrite(const fs::path& path, int64_t offset, const std::string& bytes) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(offset);
  file << bytes;
}

TEST(LogTest, WhatIsWrittenIsReadBack) {
  const ScratchFolder folder;
  writeTen(folder / "f.lcm");
  const auto events = readEvents(folder / "f.lcm");
  ASSERT_EQ(events.size(), 10u);
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(events[static_cast<size_t>(k)].number, k);
    EXPECT_EQ(events[static_cast<size_t>(k)].utime, 1000 * k);
    EXPECT_EQ(events[static_cast<size_t>(k)].channel, "A");
    EXPECT_EQ(events[static_cast<size_t>(k)].data, payload(100 + k, k));
  }
}

TEST(LogTest, LcmsOwnReaderReadsOurs) {
  const ScratchFolder folder;
  writeTen(folder / "f.lcm");
  lcm_eventlog_t* log = lcm_eventlog_create((folder / "f.lcm").c_str(), "r");
  ASSERT_NE(log, nullptr);
  int count = 0;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log)) {
    EXPECT_EQ(event->timestamp, 1000 * count);
    EXPECT_EQ(std::string(event->channel), "A");
    EXPECT_EQ(event->datalen, 100 + count);
    lcm_eventlog_free_event(event);
    ++count;
  }
  lcm_eventlog_destroy(log);
  EXPECT_EQ(count, 10);
}

TEST(LogTest, WeReadLcmsOwn) {
  const ScratchFolder folder;
  lcm_eventlog_t* log = lcm_eventlog_create((folder / "f.lcm").c_str(), "w");
  ASSERT_NE(log, nullptr);
  std::string channel = "IMU";
  auto data = payload(17, 3);
  lcm_eventlog_event_t event{};
  event.timestamp = 42;
  event.channellen = static_cast<int32_t>(channel.size());
  event.datalen = static_cast<int32_t>(data.size());
  event.channel = channel.data();
  event.data = data.data();
  ASSERT_EQ(lcm_eventlog_write_event(log, &event), 0);
  lcm_eventlog_destroy(log);
  const auto events = readEvents(folder / "f.lcm");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].utime, 42);
  EXPECT_EQ(events[0].channel, channel);
  EXPECT_EQ(events[0].data, data);
}

TEST(LogTest, MessagesKeepTheirOwnTime) {
  const ScratchFolder folder;
  ins_t message{};
  message.utime = 123456789;
  message.gyro[1] = 0.5;
  LogWriter writer(folder / "f.lcm");
  writer.write("IMU", message);
  writer.close();
  const auto events = readEvents(folder / "f.lcm");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].utime, message.utime);
  EXPECT_EQ(decoded<ins_t>(events[0]).gyro[1], 0.5);
}

TEST(LogTest, NothingIsLeftWithoutClose) {
  const ScratchFolder folder;
  {
    LogWriter writer(folder / "f.lcm");
    writer.write(1, "A", payload(100, 1));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(LogTest, AnOlderLogSurvivesAnAbandonedOne) {
  const ScratchFolder folder;
  writeTen(folder / "f.lcm");
  {
    LogWriter writer(folder / "f.lcm");
    writer.write(1, "A", payload(100, 1));
  }
  EXPECT_EQ(readEvents(folder / "f.lcm").size(), 10u);
}

TEST(LogTest, AFullDiskIsReported) {
  const ScratchFolder folder;
  const FileSizeLimit full(100'000);
  const std::string error_message = errorMessageOf([&] {
    LogWriter writer(folder / "f.lcm");
    for (int k = 0; k < 100; ++k) writer.write(k, "A", payload(10000, k));
    writer.close();
  });
  EXPECT_NE(error_message.find("f.lcm: cannot be written: File too large"), std::string::npos)
      << error_message;
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(LogTest, EveryTruncationGivesTheWholeEventsBeforeIt) {
  const ScratchFolder folder;
  const auto offsets = writeTen(folder / "f.lcm");
  const std::string whole = readText(folder / "f.lcm");
  for (size_t size = static_cast<size_t>(offsets[1]); size < whole.size(); size += 7) {
    writeText(folder / "cut.lcm", whole.substr(0, size));
    LogReader reader(folder / "cut.lcm");
    int64_t events = 0;
    while (reader.next()) ++events;
    const auto expected =
        std::upper_bound(offsets.begin(), offsets.end(), static_cast<int64_t>(size)) - offsets.begin() - 1;
    ASSERT_EQ(events, expected) << size;
    const bool on_boundary = offsets[static_cast<size_t>(expected)] == static_cast<int64_t>(size);
    ASSERT_EQ(reader.truncated(), !on_boundary) << size;
  }
}

TEST(LogTest, ADamagedEventIsSkippedAndCounted) {
  struct Damage {
    const char* what;
    int64_t into_event;
    std::string bytes;
  };
  const std::vector<Damage> damages = {
      {"sync word", 0, std::string(4, '\0')},
      {"length of the name", 20, std::string("\x7F\xFF\xFF\xFF")},
      {"negative length of the name", 20, std::string("\xFF\xFF\xFF\xFF")},
      {"huge length of the data", 24, std::string("\x7F\xFF\xFF\xFF")},
      {"negative length of the data", 24, std::string("\x80\x00\x00\x01", 4)},
      {"length of the data off by some", 24, std::string("\x00\x00\x00\x50", 4)},
  };
  for (const Damage& damage : damages) {
    const ScratchFolder folder;
    const auto offsets = writeTen(folder / "f.lcm");
    overwrite(folder / "f.lcm", offsets[4] + damage.into_event, damage.bytes);
    LogReader reader(folder / "f.lcm");
    std::vector<int64_t> numbers;
    while (const auto event = reader.next()) numbers.push_back(event->number);
    EXPECT_EQ(numbers, (std::vector<int64_t>{0, 1, 2, 3, 5, 6, 7, 8, 9})) << damage.what;
    EXPECT_EQ(reader.damaged(), 1) << damage.what;
    EXPECT_NE(reader.damageReport().find("f.lcm: byte " + std::to_string(offsets[4])), std::string::npos)
        << reader.damageReport();
  }
}

TEST(LogTest, ALogWhoseFirstEventIsDamagedStillReads) {
  const ScratchFolder folder;
  writeTen(folder / "f.lcm");
  overwrite(folder / "f.lcm", 0, "xxxx");
  LogReader reader(folder / "f.lcm");
  const auto first = reader.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->number, 1);
}

TEST(LogTest, WhatIsNoLogIsRefused) {
  const ScratchFolder folder;
  writeText(folder / "empty.lcm", "");
  writeText(folder / "text.lcm", std::string(100000, 'a'));
  const auto open = [&](const std::string& name) {
    return errorMessageOf([&] { LogReader{folder / name}; });
  };
  EXPECT_NE(open("empty.lcm").find("empty.lcm: is empty"), std::string::npos);
  EXPECT_NE(open("text.lcm").find("text.lcm: holds no LCM event"), std::string::npos);
  EXPECT_NE(open("none.lcm").find("none.lcm: no such file"), std::string::npos);
  EXPECT_NE(errorMessageOf([&] { LogReader{folder.path()}; }).find("is a folder"), std::string::npos);
}

TEST(ProgressTest, ShortWorkPrintsNothing) {
  testing::internal::CaptureStderr();
  {
    Progress progress("short", "frames");
    for (int k = 0; k < 100; ++k) progress.update(k, 100);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace redbee::test
