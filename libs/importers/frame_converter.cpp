#include "redbee/importers/frame_converter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "redbee/files/ffmpeg.hpp"

namespace redbee {
namespace {

/// The size that keeps the aspect, both sides even so that every codec takes it. Nothing is enlarged.
cv::Size scaledSize(cv::Size recorded, int wanted_width) {
  if (wanted_width <= 0 || wanted_width >= recorded.width) return recorded;
  const int even_width = std::max(2, wanted_width / 2 * 2);
  const double height = static_cast<double>(recorded.height) * even_width / recorded.width;
  return {even_width, std::max(2, 2 * static_cast<int>(std::lround(height / 2)))};
}

cv::Size turned(cv::Size size, int rotation_deg) {
  return rotation_deg % 180 == 0 ? size : cv::Size(size.height, size.width);
}

}  // namespace

void FrameConverter::Deleter::operator()(SwsContext* context) const { sws_freeContext(context); }

FrameConverter::FrameConverter(int width, bool grey, int rotation_deg)
    : width_(width), grey_(grey), rotation_deg_(rotation_deg) {}

cv::Mat FrameConverter::convert(const AVFrame& frame) {
  const cv::Size recorded(frame.width, frame.height);
  const cv::Size size = turned(scaledSize(turned(recorded, rotation_deg_), width_), rotation_deg_);
  if (!scaler_ || frame.format != format_ || recorded != size_) {
    const int method = size == recorded ? SWS_BICUBIC : SWS_AREA;
    scaler_.reset(sws_getContext(recorded.width, recorded.height, static_cast<AVPixelFormat>(frame.format),
                                 size.width, size.height, grey_ ? AV_PIX_FMT_GRAY8 : AV_PIX_FMT_BGR24,
                                 method | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
    format_ = frame.format;
    size_ = recorded;
    if (!scaler_) return {};
  }
  cv::Mat image(size, grey_ ? CV_8UC1 : CV_8UC3);
  uint8_t* planes[4] = {image.data, nullptr, nullptr, nullptr};
  const int strides[4] = {static_cast<int>(image.step), 0, 0, 0};
  sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height, planes, strides);
  if (rotation_deg_ == 0) return image;
  cv::Mat out;
  cv::rotate(image, out, rotation_deg_ / 90 - 1);  // ROTATE_90_CLOCKWISE, ROTATE_180, ...
  return out;
}

}  // namespace redbee
