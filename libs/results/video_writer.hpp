// Writes H.264 video in MP4, as browsers play it.
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>

namespace redbee {

/// Writes "<path>.partial" and renames it on close(); the partial file is removed if close() is not called.
/// Encodes with libx264 if ffmpeg has it, otherwise with another H.264 encoder, otherwise MPEG-4. Throws
/// InputError if the file cannot be written.
class VideoWriter {
 public:
  /// `size` even, as yuv420p needs; `fps` > 0. `quality`: libx264's constant rate factor, lower is better.
  VideoWriter(const std::filesystem::path& path, const cv::Size& size, double fps, int quality = 23);
  ~VideoWriter();

  /// BGR or grey, of the given size; the n-th frame is shown at n / fps.
  void write(const cv::Mat& image);
  /// The same, shown at `time_s`, later than the frame before it: for a variable frame rate.
  void write(const cv::Mat& image, double time_s);
  void close();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace redbee
