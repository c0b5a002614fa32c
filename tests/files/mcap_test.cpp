#include <gtest/gtest.h>

#include "redbee/files/mcap_reader.hpp"
#include "redbee/files/mcap_writer.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

struct Message {
  std::string topic, schema;
  int64_t log_ns;
  std::string data;
  bool operator==(const Message& other) const {
    return topic == other.topic && schema == other.schema && log_ns == other.log_ns && data == other.data;
  }
};

class McapTest : public testing::Test {
 protected:
  /// Large enough for several chunks.
  std::vector<Message> write() const {
    std::vector<Message> written;
    McapWriter writer(file_, "ros2", "test");
    const uint16_t channels[] = {writer.addChannel("/a", {"pkg/msg/A", "ros2msg", "int32 a"}, "cdr"),
                                 writer.addChannel("/b", {"pkg/msg/B", "ros2msg", "int32 b"}, "cdr"),
                                 writer.addChannel("/a2", {"pkg/msg/A", "ros2msg", "int32 a"}, "cdr")};
    const char* const names[][2] = {{"/a", "pkg/msg/A"}, {"/b", "pkg/msg/B"}, {"/a2", "pkg/msg/A"}};
    for (int k = 0; k < 12; ++k) {
      std::string data(1'000'000, static_cast<char>('a' + k));
      for (size_t i = 0; i < data.size(); i += 7) data[i] = static_cast<char>(i * static_cast<size_t>(k + 1));
      const size_t i = static_cast<size_t>(k % 3);
      writer.write(channels[i], 1000 * k, {data.begin(), data.end()});
      written.push_back({names[i][0], names[i][1], 1000 * k, data});
    }
    writer.close();
    return written;
  }
  std::vector<Message> read(McapReader& reader) const {
    std::vector<Message> all;
    reader.read([&](const McapMessage& m) {
      all.push_back(
          {m.channel->topic, m.channel->schema.name, m.log_ns, {m.data.data, m.data.data + m.data.size}});
      return true;
    });
    return all;
  }
  ScratchFolder folder_;
  fs::path file_ = folder_ / "f.mcap";
};

TEST_F(McapTest, WhatIsWrittenIsRead) {
  const auto written = write();
  McapReader reader(file_);
  EXPECT_EQ(read(reader), written);
  EXPECT_EQ(reader.damage(), "");
  EXPECT_EQ(read(reader), written) << "a second time";
}

TEST_F(McapTest, TheSummaryCountsTheMessages) {
  write();
  McapReader reader(file_);
  const auto counts = reader.summary();
  ASSERT_TRUE(counts);
  ASSERT_EQ(counts->size(), 3u);
  for (const auto& [channel, messages] : *counts) {
    EXPECT_EQ(messages, 4) << channel.topic;
    EXPECT_EQ(channel.schema.name, channel.topic == "/b" ? "pkg/msg/B" : "pkg/msg/A");
  }
  const std::string whole = readText(file_);
  std::string damaged = whole;
  damaged[whole.size() - 8 - 29 - 3] ^= 1;  // within the summary, whose CRC tells
  writeText(file_, damaged);
  EXPECT_FALSE(McapReader(file_).summary());
  writeText(file_, whole.substr(0, whole.size() / 2));
  EXPECT_FALSE(McapReader(file_).summary());
}

TEST_F(McapTest, OtherFilesAreRefused) {
  writeText(file_, "#ROSBAG V2.0\n");
  EXPECT_NE(errorMessageOf([&] { McapReader reader(file_); }).find("is no MCAP file"), std::string::npos);
  EXPECT_NE(errorMessageOf([&] { McapReader reader(folder_ / "none"); }).find("no such file"),
            std::string::npos);
}

TEST_F(McapTest, AFileThatIsNotClosedDoesNotAppear) {
  { McapWriter writer(file_, "ros2", "test"); }
  EXPECT_FALSE(fs::exists(file_));
}

}  // namespace
}  // namespace redbee::test
