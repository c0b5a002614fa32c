#include "processes/camera/gstreamer/sample_image.hpp"

#include <gst/video/video.h>

namespace redbee {
namespace {

std::optional<image_t> jpegOf(GstSample* sample, const GstStructure* format) {
  image_t image{};
  int width = 0;
  int height = 0;
  gst_structure_get_int(format, "width", &width);
  gst_structure_get_int(format, "height", &height);
  GstMapInfo map;
  if (gst_buffer_map(gst_sample_get_buffer(sample), &map, GST_MAP_READ) == FALSE) return std::nullopt;
  image.pixelformat = image_t::MJPEG;
  image.width = width;
  image.height = height;
  image.data.assign(map.data, map.data + map.size);
  image.size = static_cast<int32_t>(map.size);
  gst_buffer_unmap(gst_sample_get_buffer(sample), &map);
  return image;
}

std::optional<image_t> rawOf(GstSample* sample, GstCaps* caps) {
  GstVideoInfo info;
  GstVideoFrame frame;
  if (gst_video_info_from_caps(&info, caps) == FALSE) return std::nullopt;
  if (gst_video_frame_map(&frame, &info, gst_sample_get_buffer(sample), GST_MAP_READ) == FALSE)
    return std::nullopt;
  image_t image{};
  image.width = GST_VIDEO_FRAME_WIDTH(&frame);
  image.height = GST_VIDEO_FRAME_HEIGHT(&frame);
  const GstVideoFormat format = GST_VIDEO_FRAME_FORMAT(&frame);
  image.pixelformat = image_t::BGR;
  if (format == GST_VIDEO_FORMAT_GRAY8) image.pixelformat = image_t::GRAY;
  if (format == GST_VIDEO_FORMAT_RGB) image.pixelformat = image_t::RGB;
  image.row_stride = image.width * (format == GST_VIDEO_FORMAT_GRAY8 ? 1 : 3);
  // Rows are padded in the buffer, to four bytes or what the driver likes.
  const auto* pixels = static_cast<const uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0));
  for (int row = 0; row < image.height; ++row) {
    const uint8_t* begin = pixels + static_cast<ptrdiff_t>(row) * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0);
    image.data.insert(image.data.end(), begin, begin + image.row_stride);
  }
  image.size = static_cast<int32_t>(image.data.size());
  gst_video_frame_unmap(&frame);
  return image;
}

}  // namespace

std::optional<image_t> imageOf(GstSample* sample) {
  GstCaps* caps = gst_sample_get_caps(sample);
  if (caps == nullptr || gst_sample_get_buffer(sample) == nullptr) return std::nullopt;
  const GstStructure* format = gst_caps_get_structure(caps, 0);
  return gst_structure_has_name(format, "image/jpeg") == TRUE ? jpegOf(sample, format) : rawOf(sample, caps);
}

}  // namespace redbee
