#include "processes/rectified_camera.hpp"

#include <opencv2/imgproc.hpp>

#include "redbee/bus/image.hpp"

namespace redbee {
namespace {

/// The camera that takes images smaller by this factor.
CameraIntrinsics shrunk(CameraIntrinsics camera, int downscale) {
  camera.width /= downscale;
  camera.height /= downscale;
  camera.fx /= downscale;
  camera.fy /= downscale;
  camera.cx = (camera.cx + 0.5) / downscale - 0.5;
  camera.cy = (camera.cy + 0.5) / downscale - 0.5;
  camera.line_delay_s *= downscale;
  return camera;
}

}  // namespace

RectifiedCamera::RectifiedCamera(const CameraIntrinsics& intrinsics, int downscale,
                                 const cv::Mat1b& own_parts)
    : camera_(intrinsics),
      rectifier_(camera_, own_parts),
      downscale_(downscale),
      image_rectifier_(Camera(shrunk(intrinsics, downscale), shrunk(camera_.ideal(), downscale))) {}

IdealImage RectifiedCamera::ideal(const image_t& message, bool wants_colour, HealthMonitor& health,
                                  const Exposure& measured) {
  cv::Mat image;
  if (wants_colour) {
    image = decodeColour(message, downscale_).value_or(cv::Mat3b());
  } else {
    image = decodeGrey(message, downscale_).value_or(cv::Mat1b());
  }
  if (image.empty()) health.noteDamaged();
  const cv::Size wanted(camera_.intrinsics().width / downscale_, camera_.intrinsics().height / downscale_);
  IdealImage ideal;
  ideal.exposure.zoom = measured.zoom;
  if (image.size() != wanted) return ideal;
  if (measured.rows) {
    cv::Mat1b grey = image;
    if (wants_colour) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    ideal.exposure.rows = row_motion_.of(grey, measured.rows);
  }
  if (wants_colour) {
    ideal.colour = image_rectifier_.toIdeal(image, ideal.exposure);
    cv::cvtColor(ideal.colour, ideal.grey, cv::COLOR_BGR2GRAY);
  } else {
    ideal.grey = image_rectifier_.toIdeal(image, ideal.exposure);
  }
  return ideal;
}

}  // namespace redbee
