#include "processes/redbee/mosaic/frame_painter.hpp"

#include <opencv2/imgproc.hpp>

#include "redbee/image_codec/image_codec.hpp"

namespace redbee {
namespace {

constexpr int kMargin_px = 6;  ///< around masks, whose edges are not sharp

}  // namespace

/// On the ideal grid, not 0 where no ground is: movers by the mask and by the boxes, which cover what a mask
/// misses, and what the camera does not show.
cv::Mat1b FramePainter::leftOut(const ObservedFrame& frame, const Exposure& exposure) const {
  const CameraIntrinsics& raw_camera = camera().intrinsics();
  cv::Mat1b raw = cv::Mat1b::zeros(raw_camera.height, raw_camera.width);
  const cv::Mat1b mask = decodeGreyImage(*frame.mask);
  if (mask.size() == raw.size()) raw = mask.clone();
  if (frame.detections != nullptr) {
    for (const detection_t& d : frame.detections->detections)
      cv::rectangle(raw, cv::Rect(d.x, d.y, d.width, d.height), cv::Scalar(255), cv::FILLED);
  }
  cv::Mat1b ideal = camera_.rectifier().toIdeal(raw, exposure);
  const int side = 2 * kMargin_px + 1;
  cv::dilate(ideal, ideal, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  const Rectifier& rectifier = camera_.rectifier();
  for (const cv::Mat1b& nothing : {rectifier.unknown(exposure.zoom), rectifier.ownParts(exposure)}) {
    if (!nothing.empty()) ideal |= nothing;
  }
  return ideal;
}

bool FramePainter::paint(const image_t& image, const ObservedFrame& frame, const Eigen::Matrix3d& to_map,
                         Mosaic& mosaic) {
  if (frame.mask == nullptr) return false;
  const IdealImage ideal = camera_.ideal(image, true, health_, frame.exposure);
  if (ideal.colour.empty()) return false;
  mosaic.add(ideal.colour, leftOut(frame, ideal.exposure), to_map);
  return true;
}

}  // namespace redbee
