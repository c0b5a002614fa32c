#include "redbee/imaging/rectifier.hpp"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace redbee {
namespace {

/// Source coordinate of pixels without a source: outside every image, but within the range of the fixed-point
/// tables.
constexpr float kNowhere = -16384;

/// Source pixel of every pixel of an image of `size`.
template <typename Mapping>
cv::Mat2f tabulate(const CameraIntrinsics& size, const Mapping& mapping) {
  cv::Mat2f map(size.height, size.width);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const std::optional<Eigen::Vector2d> source = mapping(Eigen::Vector2d(u, v));
      map(v, u) = source ? cv::Vec2f(static_cast<float>(source->x()), static_cast<float>(source->y()))
                         : cv::Vec2f(kNowhere, kNowhere);
    }
  }
  return map;
}

/// `map` plus what the rows' motion adds to it: from pixels `with` to pixels `without` motion. That varies so
/// slowly over the image that it is interpolated between the middles of cells.
template <typename With, typename Without>
cv::Mat2f shifted(const cv::Mat2f& map, const With& with, const Without& without) {
  constexpr int kCell_px = 16;
  const cv::Size cells(map.cols / kCell_px + 3, map.rows / kCell_px + 3);  // one beyond each border
  cv::Mat2f shift(cells, cv::Vec2f(0, 0));
  for (int j = 0; j < cells.height; ++j) {
    for (int i = 0; i < cells.width; ++i) {
      const Eigen::Vector2d pixel((i - 0.5) * kCell_px - 0.5, (j - 0.5) * kCell_px - 0.5);
      const std::optional<Eigen::Vector2d> moved = with(pixel), still = without(pixel);
      if (!moved || !still) continue;
      const Eigen::Vector2f d = (*moved - *still).cast<float>();
      shift(j, i) = {d.x(), d.y()};
    }
  }
  cv::Mat2f full;
  cv::resize(shift, full, cells * kCell_px, 0, 0, cv::INTER_LINEAR);
  return map + full(cv::Rect({kCell_px, kCell_px}, map.size()));
}

}  // namespace

Rectifier::Rectifier(const Camera& camera, const cv::Mat1b& own_parts)
    : camera_(camera), raw_own_parts_(own_parts.clone()) {
  const cv::Size raw_size(camera.intrinsics().width, camera.intrinsics().height);
  if (!own_parts.empty() && own_parts.size() != raw_size)
    throw std::invalid_argument("the mask of the vehicle's own parts has another size than the images");
  const bool is_rolling = camera.intrinsics().line_delay_s != 0;
  const auto distort = [&](const Eigen::Vector2d& ideal) { return camera.distort(ideal); };
  const auto undistort = [&](const Eigen::Vector2d& raw) { return camera.undistort(raw); };
  if (camera.isDistorted() || is_rolling) {
    raw_sources_ = tabulate(camera.ideal(), distort);
    ideal_sources_ = tabulate(camera.intrinsics(), undistort);
  }
  if (!camera.isDistorted()) {
    own_parts_ = unknown_ = own_parts.clone();
    return;
  }
  cv::convertMaps(raw_sources_, cv::noArray(), to_ideal_1_, to_ideal_2_, CV_16SC2);
  cv::convertMaps(ideal_sources_, cv::noArray(), to_raw_1_, to_raw_2_, CV_16SC2);
  if (!is_rolling) {
    raw_sources_.release();
    ideal_sources_.release();
  }
  const cv::Mat shown(raw_size, CV_8U, cv::Scalar(0));
  cv::remap(shown, unknown_, to_ideal_1_, to_ideal_2_, cv::INTER_NEAREST, cv::BORDER_CONSTANT, 255);
  if (cv::countNonZero(unknown_) == 0) unknown_.release();
  if (own_parts.empty()) return;
  cv::remap(own_parts, own_parts_, to_ideal_1_, to_ideal_2_, cv::INTER_NEAREST, cv::BORDER_CONSTANT, 0);
  unknown_ = unknown_.empty() ? own_parts_.clone() : cv::Mat1b(unknown_ | own_parts_);
}

bool Rectifier::moves(const std::optional<RowMotion>& motion) const {
  return motion && camera_.intrinsics().line_delay_s != 0;
}

Rectifier::Moved& Rectifier::movedBy(const RowMotion& motion) const {
  if (!(moved_.motion == motion)) moved_ = {motion, {}, {}, {}};
  return moved_;
}

const cv::Mat2f& Rectifier::sourcesInRaw(const RowMotion& motion) const {
  cv::Mat2f& sources = movedBy(motion).sources_in_raw;
  if (sources.empty()) {
    sources = shifted(
        raw_sources_, [&](const Eigen::Vector2d& ideal) { return rawPixel(camera_, ideal, motion); },
        [&](const Eigen::Vector2d& ideal) { return camera_.distort(ideal); });
  }
  return sources;
}

const cv::Mat2f& Rectifier::sourcesInIdeal(const RowMotion& motion) const {
  cv::Mat2f& sources = movedBy(motion).sources_in_ideal;
  if (sources.empty()) {
    sources = shifted(
        ideal_sources_, [&](const Eigen::Vector2d& raw) { return idealPixel(camera_, raw, motion); },
        [&](const Eigen::Vector2d& raw) { return camera_.undistort(raw); });
  }
  return sources;
}

cv::Mat Rectifier::toIdeal(const cv::Mat& raw, const std::optional<RowMotion>& motion) const {
  cv::Mat ideal;
  if (moves(motion)) {
    cv::remap(raw, ideal, sourcesInRaw(*motion), cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    if (camera_.isDistorted() && !unknown_.empty()) ideal.setTo(0, unknown_);
  } else if (to_ideal_1_.empty()) {
    return raw;
  } else {
    cv::remap(raw, ideal, to_ideal_1_, to_ideal_2_, cv::INTER_LINEAR);
  }
  return ideal;
}

cv::Mat1b Rectifier::toRaw(const cv::Mat1b& ideal, uchar outside,
                           const std::optional<RowMotion>& motion) const {
  cv::Mat1b raw;
  if (moves(motion)) {
    cv::remap(ideal, raw, sourcesInIdeal(*motion), cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT,
              outside);
  } else if (to_raw_1_.empty()) {
    return ideal;
  } else {
    cv::remap(ideal, raw, to_raw_1_, to_raw_2_, cv::INTER_NEAREST, cv::BORDER_CONSTANT, outside);
  }
  return raw;
}

cv::Mat1b Rectifier::ownParts(const std::optional<RowMotion>& motion) const {
  if (!moves(motion)) return own_parts_;
  cv::Mat1b& moved = movedBy(*motion).own_parts;
  if (!moved.empty()) return moved;
  cv::Mat1b parts = raw_own_parts_;
  if (parts.empty()) parts = cv::Mat1b::zeros(camera_.intrinsics().height, camera_.intrinsics().width);
  cv::remap(parts, moved, sourcesInRaw(*motion), cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT, 255);
  return moved;
}

}  // namespace redbee
