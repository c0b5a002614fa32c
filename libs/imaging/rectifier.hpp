// Rectification: raw images to ideal images, between which homographies hold, and back.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/rolling_shutter.hpp"

namespace redbee {

/// Look-up tables for one camera. If raw and ideal pixels are the same, images are returned without a copy.
/// `motion`: of a rolling shutter's image, its rows' motion; without it, or with a global shutter, only the
/// lens is rectified. What it takes to follow the rows of one image is computed once: a Rectifier is not for
/// several threads at once.
class Rectifier {
 public:
  /// `own_parts`: 255 where raw images show the vehicle itself, which is unknown, too; of the raw images'
  /// size, or empty. Throws std::invalid_argument for another size.
  explicit Rectifier(const Camera& camera, const cv::Mat1b& own_parts = {});

  /// Raw image to ideal image, of the size and K of the camera's ideal(), bilinear; black where unknown().
  /// What only the rows' motion takes beyond the raw image's border is that border's, stretched.
  cv::Mat toIdeal(const cv::Mat& raw, const std::optional<RowMotion>& motion = {}) const;
  /// Map on the ideal grid (mask, probability) to the raw grid, nearest neighbour; `outside` where the raw
  /// pixel lies outside the ideal image.
  cv::Mat1b toRaw(const cv::Mat1b& ideal, uchar outside = 0,
                  const std::optional<RowMotion>& motion = {}) const;
  /// On the ideal grid: 255 where the raw image or the camera model has no pixel, and where the vehicle's own
  /// parts are; empty if all pixels are known.
  const cv::Mat1b& unknown() const { return unknown_; }
  /// On the ideal grid: 255 where the vehicle's own parts are; empty if there are none. With `motion` also
  /// where it takes pixels beyond the raw image's border.
  cv::Mat1b ownParts(const std::optional<RowMotion>& motion = {}) const;

 private:
  bool moves(const std::optional<RowMotion>& motion) const;
  /// Source pixels of the ideal image's and of the raw image's.
  const cv::Mat2f& sourcesInRaw(const RowMotion& motion) const;
  const cv::Mat2f& sourcesInIdeal(const RowMotion& motion) const;

  /// Of the image that was asked for last.
  struct Moved {
    std::optional<RowMotion> motion;
    cv::Mat2f sources_in_raw, sources_in_ideal;  ///< empty until they are asked for
    cv::Mat1b own_parts;
  };
  Moved& movedBy(const RowMotion& motion) const;

  Camera camera_;
  cv::Mat2f raw_sources_, ideal_sources_;  ///< without motion; only of a rolling shutter
  cv::Mat to_ideal_1_, to_ideal_2_;
  cv::Mat to_raw_1_, to_raw_2_;
  cv::Mat1b unknown_;
  cv::Mat1b raw_own_parts_, own_parts_;
  mutable Moved moved_;
};

}  // namespace redbee
