// H.264 in MP4, as browsers play it.
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>

namespace redbee {

/// Writes "<path>.partial" and renames it on close(); destroyed without close() it leaves nothing. Encodes
/// with libx264 where ffmpeg has it, else with any other H.264 encoder that opens, else MPEG-4. Throws
/// InputError if the file cannot be written.
class VideoWriter {
 public:
  /// `size` even, as yuv420p needs; `fps` > 0. `quality`: libx264's constant rate factor, lower is better.
  VideoWriter(const std::filesystem::path& path, const cv::Size& size, double fps, int quality = 23);
  ~VideoWriter();

  /// BGR or grey, of the size given; the frame is shown at index / fps.
  void write(const cv::Mat& image);
  void close();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace redbee
