// Ground-truth masks as public data sets code them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace redbee {

/// The masks of a folder: its PNGs, or its JPEGs where there are none; sorted. Empty if it is no folder.
std::vector<std::filesystem::path> masksIn(const std::filesystem::path& folder);

/// The number that a name ends with. Throws InputError without one.
int64_t numberIn(const std::filesystem::path& file);
/// True unless the name is a time: a number without leading zeros.
bool looksLikeFrameNumber(const std::filesystem::path& file);
/// True for the names of data sets that count frames from 1: CDnet's gt000001.png.
bool countsFromOne(const std::filesystem::path& file);

/// How the masks of a clip are coded: decided over all of them, because a mask without movers shows nothing.
///
///   grey, somewhere 255    255 moves, 0 does not, any other value is unknown (CDnet: 50, 85, 170)
///   grey, nowhere above 1  1 moves
///   colours                of a palette, as DAVIS has it: black does not move, VOC's (224, 224, 192) is
///   unknown,
///                          any other moves
///   JPEG                   from 192 on moves, up to 63 does not
class TruthMasks {
 public:
  /// Throws InputError for grey values that are none of these, such as object numbers, naming the file.
  explicit TruthMasks(const std::vector<std::filesystem::path>& files);
  TruthMasks() = default;

  /// 255 moves, 0 does not, any other value is unknown. Throws InputError if the file is no mask, such as an
  /// image with thousands of colours.
  cv::Mat1b read(const std::filesystem::path& file) const;

 private:
  int moving_ = 255;  ///< the grey value of what moves
};

}  // namespace redbee
