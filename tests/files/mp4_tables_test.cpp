// Counts in an MP4 that ffmpeg would allot memory for.
#include "redbee/files/mp4_tables.hpp"

#include <gtest/gtest.h>

#include "tests/support/log_events.hpp"
#include "tests/support/mp4_edits.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

constexpr uint32_t kMany = 54'149'124;

/// A table within the boxes that are around it.
std::string within(const std::vector<std::string>& boxes, const std::string& table) {
  std::string bytes = table;
  for (auto box = boxes.rbegin(); box != boxes.rend(); ++box) bytes = mp4Box(*box, bytes);
  return mp4Box("ftyp", "isom") + bytes;
}

const std::vector<std::string> kTrack{"moov", "trak", "mdia", "minf", "stbl"};

std::string faultOf(const std::string& bytes) {
  const ScratchFolder folder;
  writeText(folder / "v.mp4", bytes);
  const std::string error = errorMessageOf([&] { requirePossibleTables(folder / "v.mp4"); });
  return error.empty() ? error : error.substr(error.find(": ") + 2);
}

TEST(Mp4Tables, MoreSamplesThanTheFileHasBytesAreRefused) {
  const std::string sizes = mp4Bytes(0) + mp4Bytes(6'348'800) + mp4Bytes(kMany);
  EXPECT_EQ(faultOf(within(kTrack, mp4Box("stsz", sizes))),
            "is damaged: it states 54149124 samples in 72 bytes");
  const std::string list = mp4Bytes(0) + mp4Bytes(0) + mp4Bytes(kMany) + mp4Bytes(9);
  EXPECT_NE(faultOf(within(kTrack, mp4Box("stsz", list))), "");
  EXPECT_NE(faultOf(within(kTrack, mp4Box("stz2", mp4Bytes(0) + mp4Bytes(4) + mp4Bytes(kMany)))), "");
  EXPECT_NE(faultOf(within({"moof", "traf"}, mp4Box("trun", mp4Bytes(0x200) + mp4Bytes(kMany)))), "");
  EXPECT_NE(faultOf(within({"moof", "traf"}, mp4Box("trun", mp4Bytes(0) + mp4Bytes(kMany)))), "");
  // Of all tracks together.
  std::string tracks;
  for (int k = 0; k < 20; ++k)
    tracks += within(kTrack, mp4Box("stsz", mp4Bytes(0) + mp4Bytes(6) + mp4Bytes(kMany / 50)));
  EXPECT_NE(faultOf(tracks), "");
}

TEST(Mp4Tables, WhatFfmpegCanRefuseItselfIsLeftToIt) {
  EXPECT_EQ(faultOf(within(kTrack, mp4Box("stsz", mp4Bytes(0) + mp4Bytes(6) + mp4Bytes(5'000'000)))), "");
  EXPECT_EQ(faultOf(""), "");
  EXPECT_EQ(faultOf("RIFF....AVI LIST"), "");
  EXPECT_EQ(faultOf(mp4Bytes(7) + "moov"), "");
  EXPECT_EQ(faultOf(mp4Bytes(1) + "mdat" + mp4Bytes(0x7fffffff) + mp4Bytes(0xffffffff)), "");
  EXPECT_EQ(faultOf(mp4Bytes(1) + "mdat" + mp4Bytes(0xffffffff) + mp4Bytes(0xffffffff)), "");
  EXPECT_EQ(faultOf(mp4Box("moov", mp4Box("stsz", ""))), "");
  std::string deep;
  for (int k = 0; k < 1000; ++k) deep = mp4Box("trak", deep);
  EXPECT_EQ(faultOf(deep), "");
}

}  // namespace
}  // namespace redbee::test
