#include "processes/rectified_camera.hpp"

#include <opencv2/imgproc.hpp>

#include "messaging/picture.hpp"

namespace redbee {

IdealPicture RectifiedCamera::ideal(const image_t& message, bool wants_colour, HealthMonitor& health) const {
  const cv::Mat picture = (wants_colour ? decodeColour(message) : decodeGrey(message)).value_or(cv::Mat());
  if (picture.empty()) health.noteDamaged();
  if (picture.cols != camera_.intrinsics().width || picture.rows != camera_.intrinsics().height) return {};
  IdealPicture ideal;
  if (wants_colour) {
    ideal.colour = rectifier_.toIdeal(picture);
    cv::cvtColor(ideal.colour, ideal.grey, cv::COLOR_BGR2GRAY);
  } else {
    ideal.grey = rectifier_.toIdeal(picture);
  }
  return ideal;
}

}  // namespace redbee
