// What is left of a damaged MCAP file.
#include <gtest/gtest.h>

#include <algorithm>

#include "redbee/files/mcap_reader.hpp"
#include "redbee/files/mcap_writer.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/mcap_bytes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

constexpr int kChunks = 4, kMessages = 5;

/// Of message k: nothing that looks like a record.
std::string dataOf(int k) { return "message " + std::to_string(k) + std::string(100, 'x'); }

std::string chunkOf(int number, bool has_crc = true) {
  std::string records = mcapSchema(1, "pkg/msg/A") + mcapChannel(1, 1, "/a");
  for (int k = 0; k < kMessages; ++k)
    records += mcapMessage(1, static_cast<uint64_t>(number), dataOf(number * kMessages + k));
  return mcapChunk(records, has_crc);
}

class McapDamageTest : public testing::Test {
 protected:
  McapDamageTest() {
    for (int i = 0; i < kChunks; ++i) chunks_.push_back(chunkOf(i));
  }
  std::string whole() const {
    std::string file = mcapHeader();
    for (const std::string& chunk : chunks_) file += chunk;
    return file + mcapEnd();
  }
  size_t startOf(int chunk) const {
    size_t at = mcapHeader().size();
    for (int i = 0; i < chunk; ++i) at += chunks_[static_cast<size_t>(i)].size();
    return at;
  }
  static std::vector<std::string> read(McapReader& reader) {
    std::vector<std::string> all;
    reader.read([&](const McapMessage& m) {
      if (m.channel->topic == "/a") all.emplace_back(m.data.data, m.data.data + m.data.size);
      return true;
    });
    return all;
  }
  /// Messages that `file` gives; it must be called damaged.
  std::vector<std::string> salvaged(const std::string& file, const std::string& what) const {
    writeText(file_, file);
    McapReader reader(file_);
    auto found = read(reader);
    EXPECT_NE(reader.damage().find(what), std::string::npos) << reader.damage();
    EXPECT_EQ(reader.damage().find('\n'), std::string::npos);
    EXPECT_EQ(read(reader), found) << "a second time";
    return found;
  }
  /// All but those of `lost`.
  static std::vector<std::string> allBut(const std::vector<int>& lost) {
    std::vector<std::string> all;
    for (int k = 0; k < kChunks * kMessages; ++k) {
      if (std::find(lost.begin(), lost.end(), k) == lost.end()) all.push_back(dataOf(k));
    }
    return all;
  }
  ScratchFolder folder_;
  fs::path file_ = folder_ / "f.mcap";
  std::vector<std::string> chunks_;
};

TEST_F(McapDamageTest, AWrongCrcCostsNoOtherMessage) {
  std::string file = whole();
  const size_t at = file.find("message 7");
  file[at] = 'M';
  auto expected = allBut({});
  expected[7][0] = 'M';
  EXPECT_EQ(salvaged(file, "byte " + std::to_string(startOf(1)) + ": a chunk's CRC is wrong"), expected);
}

TEST_F(McapDamageTest, ADamagedLengthCostsItsMessage) {
  for (const bool has_crc : {true, false}) {
    for (int i = 0; i < kChunks; ++i) chunks_[static_cast<size_t>(i)] = chunkOf(i, has_crc);
    for (const char* length : {"\xff\xff", "\x01\x00"}) {
      std::string file = whole();
      const size_t at = file.find("message 7") - 22 - 8;  // its record's length
      file.replace(at, 2, std::string(length, 2));
      EXPECT_EQ(salvaged(file, "byte " + std::to_string(startOf(1))), allBut({7}));
    }
  }
}

TEST_F(McapDamageTest, ADamagedHeadOfAChunkCostsNothingBehindIt) {
  for (const size_t byte : {size_t{0}, size_t{1}, size_t{8}, size_t{25}, size_t{37}, size_t{41}}) {
    std::string file = whole();
    file[startOf(1) + byte] = static_cast<char>(0xEE);
    EXPECT_EQ(salvaged(file, "byte "), allBut({})) << byte;
  }
}

TEST_F(McapDamageTest, AHoleCostsWhatWasInIt) {
  std::string file = whole();
  const size_t from = file.find("message 8"), to = file.find("message 11");
  file.replace(from, to - from, std::string(to - from, '\0'));
  auto found = salvaged(file, "byte ");
  // Of message 8 the record is whole; what is in it is not.
  found.erase(std::remove(found.begin(), found.end(), std::string(dataOf(8).size(), '\0')), found.end());
  EXPECT_EQ(found, allBut({8, 9, 10, 11}));
}

TEST_F(McapDamageTest, ANameFromADamagedChunkCountsUntilAnotherComes) {
  std::string file = whole();
  file[file.find("/a")] = '\\';
  EXPECT_EQ(salvaged(file, "a chunk's CRC is wrong"), allBut({0, 1, 2, 3, 4}));
}

TEST_F(McapDamageTest, OfAFileThatIsCutShortWhatIsWholeIsRead) {
  const std::string file = whole();
  EXPECT_EQ(salvaged(file.substr(0, file.find("message 12")), "cut short"),
            allBut({12, 13, 14, 15, 16, 17, 18, 19}));
  EXPECT_EQ(salvaged(file.substr(0, startOf(2)), "cut short"),
            allBut({10, 11, 12, 13, 14, 15, 16, 17, 18, 19}));
}

TEST_F(McapDamageTest, CompressedChunksAreReadAsFarAsTheyGo) {
  McapWriter writer(file_, "ros2", "test");
  const uint16_t channel = writer.addChannel("/a", {"pkg/msg/A", "ros2msg", ""}, "cdr");
  std::vector<std::string> written;
  uint32_t noise = 1;  // what does not compress
  for (int k = 0; k < 40; ++k) {
    std::string data(300'000, '\0');
    for (char& c : data) c = static_cast<char>((noise = noise * 1664525 + 1013904223) >> 24);
    writer.write(channel, k, {data.begin(), data.end()});
    written.push_back(data);
  }
  writer.close();
  const std::string file = readText(file_);
  const size_t middle = file.size() / 2;
  const auto before = salvaged(file.substr(0, middle), "cut short");
  EXPECT_GE(before.size(), 17u);  // all but what a block of the compression is cut in
  EXPECT_TRUE(std::equal(before.begin(), before.end(), written.begin()));
  std::string holed = file;
  for (size_t i = 0; i < 20; ++i) holed[middle + i] = static_cast<char>(~holed[middle + i]);
  const auto around = salvaged(holed, "a chunk");
  EXPECT_GE(around.size(), 20u);
  EXPECT_EQ(around.back(), written.back());
}

}  // namespace
}  // namespace redbee::test
