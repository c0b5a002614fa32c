// Rectification: raw images to ideal images, between which homographies hold, and back.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/rolling_shutter.hpp"

namespace redbee {

/// How an image was taken, as far as it differs from what the camera is configured as.
struct Exposure {
  /// Of a rolling shutter; without it, or with a global shutter, only the lens is rectified.
  std::optional<RowMotion> rows;
  double zoom = 1;  ///< focal length over the configured one: of the raw image, and of its ideal image

  bool operator==(const Exposure& other) const { return rows == other.rows && zoom == other.zoom; }
};

/// Look-up tables for one camera. If raw and ideal pixels are the same, images are returned without a copy.
/// What it takes to follow the rows or the lens of an image is computed once for each of the two exposures
/// that were asked for last: a Rectifier is not for several threads at once.
class Rectifier {
 public:
  /// `own_parts`: 255 where raw images of the configured focal length show the vehicle itself, which is
  /// unknown, too; of the raw images' size, or empty. Throws std::invalid_argument for another size.
  explicit Rectifier(const Camera& camera, const cv::Mat1b& own_parts = {});

  /// Raw image to ideal image, of the size and K of the camera's ideal(), bilinear; black where unknown().
  /// What only the rows' motion takes beyond the raw image's border is that border's, stretched.
  cv::Mat toIdeal(const cv::Mat& raw, const Exposure& exposure = {}) const;
  /// Map on the ideal grid (mask, probability) to the raw grid, nearest neighbour; `outside` where the raw
  /// pixel lies outside the ideal image.
  cv::Mat1b toRaw(const cv::Mat1b& ideal, uchar outside = 0, const Exposure& exposure = {}) const;
  /// On the ideal grid: 255 where the raw image or the camera model has no pixel, and where the vehicle's own
  /// parts are; empty if all pixels are known.
  const cv::Mat1b& unknown() const { return unknown_; }
  /// The same with the lens at `zoom`.
  cv::Mat1b unknown(double zoom) const;
  /// On the ideal grid: 255 where the vehicle's own parts are, and where the exposure takes pixels beyond the
  /// raw image's border; empty if there are none.
  cv::Mat1b ownParts(const Exposure& exposure = {}) const;

 private:
  bool rolls(const Exposure& exposure) const;
  /// Whether the pixels have other sources than the camera's as it is configured.
  bool moves(const Exposure& exposure) const;
  /// Source pixels of the ideal image's and of the raw image's.
  const cv::Mat2f& sourcesInRaw(const Exposure& exposure) const;
  const cv::Mat2f& sourcesInIdeal(const Exposure& exposure) const;
  using Rows = std::optional<RowMotion>;
  /// On `grid`; `mapping(lens, pixel, rows)` has a pixel's source, `still` those without motion and zoom.
  template <typename Mapping>
  cv::Mat2f sourcesBy(const Exposure& exposure, const CameraIntrinsics& grid, const cv::Mat2f& still,
                      const Mapping& mapping) const;
  cv::Mat1b rawOwnParts(double zoom) const;

  struct Moved {
    Exposure exposure;
    cv::Mat2f sources_in_raw, sources_in_ideal;  ///< empty until they are asked for
    cv::Mat1b own_parts;
  };
  Moved& movedBy(const Exposure& exposure) const;

  Camera camera_;
  cv::Mat2f raw_sources_, ideal_sources_;  ///< without motion; only of a rolling shutter
  cv::Mat to_ideal_1_, to_ideal_2_;
  cv::Mat to_raw_;
  cv::Mat1b unknown_;
  cv::Mat1b raw_own_parts_, own_parts_;
  mutable std::array<Moved, 2> moved_;  ///< the one that was asked for last comes first
};

}  // namespace redbee
