// Reads the frames of a video file in the order of their times, and the packets of a data track.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace redbee {

struct VideoFrame {
  int64_t utime = 0;  ///< us, on the video's clock (presentation time)
  cv::Mat image;      ///< 8-bit, grey or BGR as requested
};

/// A packet of a data track.
struct DataPacket {
  double start_s = 0;  ///< on the video's clock
  double duration_s = 0;
  std::vector<uint8_t> bytes;
};

struct VideoReaderOptions {
  int width =
      0;  ///< px, even, of the returned frames; the height follows from the aspect ratio. 0: as recorded
  bool grey = false;  ///< luma only; false: BGR
};

/// Throws InputError: no video stream, no frames, a truncated file (stating the last good frame), times that
/// do not increase.
class VideoReader {
 public:
  VideoReader(const std::filesystem::path& path, const VideoReaderOptions& options);
  ~VideoReader();

  std::optional<VideoFrame> next();
  /// As stated by the container; 0 if it does not.
  int64_t expectedFrames() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// All packets of the data track with this four-letter tag ("gpmd"); empty if there is no such track. Throws
/// InputError if the file is not a media container or is truncated.
std::vector<DataPacket> readDataTrack(const std::filesystem::path& path, const std::string& tag);

}  // namespace redbee
