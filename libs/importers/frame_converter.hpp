// Decoded frames as images: scaled and turned.
#pragma once

#include <memory>
#include <opencv2/core.hpp>

struct AVFrame;
struct SwsContext;

namespace redbee {

class FrameConverter {
 public:
  /// `width`: px, at most, of the turned image; 0: as recorded. `rotation_deg`: clockwise, a multiple of 90.
  FrameConverter(int width, bool grey, int rotation_deg);

  /// 8-bit grey or BGR; empty if the pixel format cannot be converted.
  cv::Mat convert(const AVFrame& frame);

 private:
  struct Deleter {
    void operator()(SwsContext* context) const;
  };

  int width_;
  bool grey_;
  int rotation_deg_;
  std::unique_ptr<SwsContext, Deleter> scaler_;
  int format_ = -1;
  cv::Size size_;
};

}  // namespace redbee
