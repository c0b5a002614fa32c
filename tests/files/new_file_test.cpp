// Files appear whole or not at all, and what another user has put under their name is not written through.
#include "redbee/files/new_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "redbee/files/atomic_file.hpp"
#include "redbee/files/csv.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/files/json_file.hpp"
#include "redbee/files/log.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

/// Writes "content" to `f` where `link` points to somebody's file.
void writeBeside(const ScratchFolder& folder, const char* link) {
  writeText(folder / "victim", "mine");
  fs::create_symlink(folder / "victim", folder / link);
  writeAtomically(folder / "f", "content");
  EXPECT_EQ(readText(folder / "victim"), "mine");
  EXPECT_EQ(readText(folder / "f"), "content");
}

TEST(PartialFileTest, APlantedLinkIsNotWrittenThrough) { writeBeside(ScratchFolder(), "f.partial"); }

TEST(PartialFileTest, ALinkUnderTheNameItselfIsReplaced) {
  const ScratchFolder folder;
  writeBeside(folder, "f");
  EXPECT_FALSE(fs::is_symlink(folder / "f"));
}

TEST(PartialFileTest, WhatAKilledRunLeftIsReplaced) {
  const ScratchFolder folder;
  writeText(folder / "f.partial", "half of something long");
  writeAtomically(folder / "f", "content");
  EXPECT_EQ(readText(folder / "f"), "content");
  EXPECT_FALSE(fs::exists(folder / "f.partial"));
}

TEST(PartialFileTest, NothingRemainsWithoutCommit) {
  const ScratchFolder folder;
  PartialFile(folder / "f").write("content");
  AtomicFile(folder / "g").write(std::string(1 << 20, 'x'));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(WritableFolder, IsOneThatIsThereOrCanBeMade) {
  const ScratchFolder folder;
  fs::create_directory(folder / "there");
  checkWritableFolder(folder / "there");
  checkWritableFolder(folder / "a" / "b");
  EXPECT_TRUE(fs::is_empty(folder / "there"));
  EXPECT_FALSE(fs::exists(folder / "a"));
  writeText(folder / "file", "content");
  EXPECT_THROW(checkWritableFolder(folder / "file"), InputError);
  EXPECT_THROW(checkWritableFolder(folder / "file" / "b"), InputError);
  EXPECT_EQ(readText(folder / "file"), "content");
}

TEST(PartialFileTest, AFolderADeviceOrAPipeIsNotReplaced) {
  const ScratchFolder folder;
  fs::create_directory(folder / "folder");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(PartialFile(folder / "folder"), InputError);
  EXPECT_THROW(PartialFile(folder / "pipe"), InputError);
  EXPECT_FALSE(fs::exists(folder / "folder.partial"));
  EXPECT_FALSE(fs::exists(folder / "pipe.partial"));
  fs::create_symlink("/dev/null", folder / "device");
  EXPECT_THROW(PartialFile(folder / "device"), InputError);
  EXPECT_TRUE(fs::is_symlink(folder / "device"));
}

TEST(PartialFileTest, LargeAndSmallWritesStayInOrder) {
  const ScratchFolder folder;
  AtomicFile file(folder / "f");
  std::string expected;
  for (const size_t size : {10, 100'000, 65'530, 20, 1'000'000, 0, 1}) {
    const std::string part(size, static_cast<char>('a' + expected.size() % 26));
    file.write(part);
    expected += part;
  }
  file.close();
  EXPECT_EQ(readText(folder / "f"), expected);
}

TEST(InputFileTest, OnlyAFileIsOpened) {
  const ScratchFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const fs::path& path : {folder / "pipe", folder.path(), fs::path("/dev/zero"), folder / "none"}) {
    EXPECT_THROW(LogReader{path}, InputError) << path;
    EXPECT_THROW(CsvReader{path}, InputError) << path;
    EXPECT_THROW(readJson(path), InputError) << path;
  }
  writeText(folder / "file", "1,2\\n");
  fs::create_symlink(folder / "file", folder / "link");
  EXPECT_EQ(faultOfFile(folder / "link"), "");
}

}  // namespace
}  // namespace redbee::test
