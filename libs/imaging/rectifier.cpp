#include "redbee/imaging/rectifier.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

namespace redbee {
namespace {

/// Source coordinate of pixels without a source: outside every image, but within the range of the fixed-point
/// tables.
constexpr float kNowhere = -16384;
constexpr bool kNearest = true;  // of cv::convertMaps(): rounds; its other tables end in the pixel below

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

/// The same for a mapping that is smooth where it is defined: interpolated within cells that have a source at
/// each corner.
template <typename Mapping>
cv::Mat2f interpolated(const CameraIntrinsics& size, const Mapping& mapping) {
  constexpr int kCell_px = 8;
  cv::Mat2f map(size.height, size.width);
  const auto sourceAt = [&](int u, int v) -> std::optional<cv::Vec2f> {
    const std::optional<Eigen::Vector2d> source = mapping(Eigen::Vector2d(u, v));
    if (!source) return std::nullopt;
    return cv::Vec2f(static_cast<float>(source->x()), static_cast<float>(source->y()));
  };
  const int columns = size.width / kCell_px + 2;
  const auto cornersAt = [&](int v) {
    std::vector<std::optional<cv::Vec2f>> corners;
    corners.reserve(static_cast<size_t>(columns));
    for (int i = 0; i < columns; ++i) corners.push_back(sourceAt(i * kCell_px, v));
    return corners;
  };
  auto above = cornersAt(0);
  for (int v0 = 0; v0 < size.height; v0 += kCell_px) {
    const auto below = cornersAt(v0 + kCell_px);
    for (int v = v0; v < std::min(v0 + kCell_px, size.height); ++v) {
      const float down = static_cast<float>(v - v0) / kCell_px;
      for (int u = 0; u < size.width; ++u) {
        const auto i = static_cast<size_t>(u / kCell_px);
        if (above[i] && above[i + 1] && below[i] && below[i + 1]) {
          const float right = static_cast<float>(u % kCell_px) / kCell_px;
          map(v, u) = (1 - down) * ((1 - right) * *above[i] + right * *above[i + 1]) +
                      down * ((1 - right) * *below[i] + right * *below[i + 1]);
        } else {
          map(v, u) = sourceAt(u, v).value_or(cv::Vec2f(kNowhere, kNowhere));
        }
      }
    }
    above = below;
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
  cv::convertMaps(ideal_sources_, cv::noArray(), to_raw_, cv::noArray(), CV_16SC2, kNearest);
  cv::Mat nearest;
  cv::convertMaps(raw_sources_, cv::noArray(), nearest, cv::noArray(), CV_16SC2, kNearest);
  if (!is_rolling) {
    raw_sources_.release();
    ideal_sources_.release();
  }
  const cv::Mat shown(raw_size, CV_8U, cv::Scalar(0));
  cv::remap(shown, unknown_, nearest, cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT, 255);
  if (cv::countNonZero(unknown_) == 0) unknown_.release();
  if (own_parts.empty()) return;
  cv::remap(own_parts, own_parts_, nearest, cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT, 0);
  unknown_ = unknown_.empty() ? own_parts_.clone() : cv::Mat1b(unknown_ | own_parts_);
}

bool Rectifier::rolls(const Exposure& exposure) const {
  return exposure.rows && camera_.intrinsics().line_delay_s != 0;
}

bool Rectifier::moves(const Exposure& exposure) const {
  return rolls(exposure) || (exposure.zoom != 1 && camera_.isDistorted());
}

Rectifier::Moved& Rectifier::movedBy(const Exposure& exposure) const {
  if (moved_[0].exposure == exposure) return moved_[0];
  std::swap(moved_[0], moved_[1]);
  if (!(moved_[0].exposure == exposure)) moved_[0] = {exposure, {}, {}, {}};
  return moved_[0];
}

template <typename Mapping>
cv::Mat2f Rectifier::sourcesBy(const Exposure& exposure, const CameraIntrinsics& grid, const cv::Mat2f& still,
                               const Mapping& mapping) const {
  const Rows rows = rolls(exposure) ? exposure.rows : std::nullopt;
  if (exposure.zoom != 1) {
    const Camera lens = zoomed(camera_, exposure.zoom);
    return interpolated(grid, [&](const Eigen::Vector2d& pixel) { return mapping(lens, pixel, rows); });
  }
  return shifted(
      still, [&](const Eigen::Vector2d& pixel) { return mapping(camera_, pixel, rows); },
      [&](const Eigen::Vector2d& pixel) { return mapping(camera_, pixel, std::nullopt); });
}

const cv::Mat2f& Rectifier::sourcesInRaw(const Exposure& exposure) const {
  cv::Mat2f& sources = movedBy(exposure).sources_in_raw;
  if (!sources.empty()) return sources;
  return sources = sourcesBy(exposure, camera_.ideal(), raw_sources_,
                             [](const Camera& lens, const Eigen::Vector2d& ideal, const Rows& rows) {
                               return rows ? rawPixel(lens, ideal, *rows) : lens.distort(ideal);
                             });
}

const cv::Mat2f& Rectifier::sourcesInIdeal(const Exposure& exposure) const {
  cv::Mat2f& sources = movedBy(exposure).sources_in_ideal;
  if (!sources.empty()) return sources;
  return sources = sourcesBy(exposure, camera_.intrinsics(), ideal_sources_,
                             [](const Camera& lens, const Eigen::Vector2d& raw, const Rows& rows) {
                               return rows ? idealPixel(lens, raw, *rows) : lens.undistort(raw);
                             });
}

cv::Mat Rectifier::toIdeal(const cv::Mat& raw, const Exposure& exposure) const {
  cv::Mat ideal;
  if (moves(exposure)) {
    const bool is_stretched = rolls(exposure);
    cv::remap(raw, ideal, sourcesInRaw(exposure), cv::noArray(), cv::INTER_LINEAR,
              is_stretched ? cv::BORDER_REPLICATE : cv::BORDER_CONSTANT);
    if (is_stretched && camera_.isDistorted()) {
      const cv::Mat1b nothing = unknown(exposure.zoom);
      if (!nothing.empty()) ideal.setTo(0, nothing);
    }
  } else if (to_ideal_1_.empty()) {
    return raw;
  } else {
    cv::remap(raw, ideal, to_ideal_1_, to_ideal_2_, cv::INTER_LINEAR);
  }
  return ideal;
}

cv::Mat1b Rectifier::toRaw(const cv::Mat1b& ideal, uchar outside, const Exposure& exposure) const {
  cv::Mat1b raw;
  if (moves(exposure)) {
    cv::remap(ideal, raw, sourcesInIdeal(exposure), cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT,
              outside);
  } else if (to_raw_.empty()) {
    return ideal;
  } else {
    cv::remap(ideal, raw, to_raw_, cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT, outside);
  }
  return raw;
}

cv::Mat1b Rectifier::unknown(double zoom) const {
  return zoom == 1 ? unknown_ : ownParts({std::nullopt, zoom});
}

/// What is fixed to the lens' body grows with the focal length.
cv::Mat1b Rectifier::rawOwnParts(double zoom) const {
  if (zoom == 1 || raw_own_parts_.empty()) return raw_own_parts_;
  const CameraIntrinsics& camera = camera_.intrinsics();
  const cv::Matx23d grow(zoom, 0, (1 - zoom) * camera.cx, 0, zoom, (1 - zoom) * camera.cy);
  cv::Mat1b grown;
  cv::warpAffine(raw_own_parts_, grown, grow, raw_own_parts_.size(), cv::INTER_NEAREST, cv::BORDER_REPLICATE);
  return grown;
}

cv::Mat1b Rectifier::ownParts(const Exposure& exposure) const {
  if (!moves(exposure)) return exposure.zoom == 1 ? own_parts_ : rawOwnParts(exposure.zoom);
  cv::Mat1b& moved = movedBy(exposure).own_parts;
  if (!moved.empty()) return moved;
  cv::Mat1b parts = rawOwnParts(exposure.zoom);
  if (parts.empty()) parts = cv::Mat1b::zeros(camera_.intrinsics().height, camera_.intrinsics().width);
  cv::remap(parts, moved, sourcesInRaw(exposure), cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT, 255);
  return moved;
}

}  // namespace redbee
