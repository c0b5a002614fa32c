// Reads the frames of a video file in the order of their times.
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
  cv::Mat image;      ///< 8-bit, grey or BGR as requested, turned as the video states
};

struct VideoReaderOptions {
  int width = 0;            ///< px, at most, of the returned frames; the height follows. 0: as recorded
  bool grey = false;        ///< luma only; false: BGR
  double fps = 0;           ///< Hz, of a stream without times, such as raw H.264
  bool keep_going = false;  ///< damage is passed over: up to the next key frame, or the end
};

/// Frames without a presentation time, as AVI has them, take the decoding times in their order; those of a
/// stream without any times `fps`. A rotation that the container states (display matrix) is applied.
///
/// Throws InputError: no video stream, no frames, a stream without times and no `fps`, damage (stating the
/// last good frame), times that do not increase. With `keep_going` the last two are in warnings() instead.
class VideoReader {
 public:
  VideoReader(const std::filesystem::path& path, const VideoReaderOptions& options);
  ~VideoReader();

  std::optional<VideoFrame> next();
  /// As stated by the container; 0 if it does not.
  int64_t expectedFrames() const;
  /// As stated by the container, us; 0 if it does not.
  int64_t duration() const;
  /// Degrees by which the images are turned clockwise: 0, 90, 180 or 270.
  int rotation_deg() const;
  /// Width over height of the turned images' pixels; 1 where nothing else is stated.
  double pixelAspect() const;
  /// One line each, complete after the last frame.
  std::vector<std::string> warnings() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace redbee
