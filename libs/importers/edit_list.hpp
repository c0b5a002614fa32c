// The cuts of an MP4 that was cut without encoding, by its edit list.
#pragma once

#include <cstdint>
#include <filesystem>
#include <unordered_map>

struct AVFormatContext;
struct AVStream;

namespace redbee {

/// ffmpeg shows the first frame behind a cut at the cut's time, up to a period too early, and closes what was
/// cut out. In truth frames keep their times on the recorder's clock, on which the data tracks are
/// (readDataTrack()); 0 is the time of the first cut.
class EditList {
 public:
  /// Of a stream that ffmpeg opened in its ordinary way; of another container there is nothing to do. Throws
  /// InputError.
  EditList(const std::filesystem::path& file, const AVFormatContext& input, const AVStream& stream);

  /// Ticks by which a frame comes later than ffmpeg has it. `position`: byte of its packet in the file.
  int64_t shiftAt(int64_t position) const;

 private:
  std::unordered_map<int64_t, int64_t> shifts_;  ///< of those that are moved
};

}  // namespace redbee
