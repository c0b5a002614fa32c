// What a region of the image is judged by: by how much it, and what surrounds it, differs from the background
// and from the registered ground, how it moves, how it is outlined, and how large it is. An object on open
// ground is alone; a piece of a trunk, a post or a crown goes on beyond its outline. Geometry and differences
// only: no colour or brightness of its own.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/detection/foreground_maps.hpp"

namespace redbee {

/// The ground in the current camera's frame: normal' X = height_m.
struct GroundPlane {
  Eigen::Vector3d normal;
  double height_m;
  Eigen::Matrix3d K;  ///< [px]
};

enum class RegionFeature : size_t {
  kLevel,      ///< number of the level of the appearance difference at which it was found
  kLogArea,    ///< natural logarithm of px^2
  kFill,       ///< fraction of its box
  kAtBorder,   ///< 1 at the image's border, else 0
  kGroundOwn,  ///< means of GroundDifference, 0 to 255: of its pixels, 3 to 7 px and 7 to 16 px around it
  kGroundNear,
  kGroundFar,
  kAppearanceOwn,  ///< the same of the appearance difference
  kAppearanceNear,
  kAppearanceFar,
  kMotionOwn,  ///< of the evidence of motion
  kMotionNear,
  kMotionFar,
  kForegroundOwn,  ///< and of their product
  kForegroundNear,
  kForegroundFar,
  kGroundMost,  ///< greatest value of its pixels
  kForegroundMost,
  kLogWidth_m,  ///< natural logarithm, if its lower edge is on the ground; not a number if that is not known
  kLogHeight_m,
  kAppearanceMost,
  kContrastLeast,  ///< least grey-level contrast of eight sectors of its outline, second least, median, mean
  kContrastSecond,
  kContrastMedian,
  kContrastMean,
  kCount
};
constexpr size_t kRegionFeatures = static_cast<size_t>(RegionFeature::kCount);
/// In the order of RegionFeature, as the training's table has them.
extern const std::array<const char*, kRegionFeatures> kRegionFeatureNames;
using RegionFeatures = std::array<float, kRegionFeatures>;

class RegionMeter {
 public:
  /// Keeps references to `maps` and `ground`. `maps`: with appearance, motion, ground and colours. `image`:
  /// its size.
  RegionMeter(const ForegroundMaps& maps, cv::Size image, const std::optional<GroundPlane>& ground);

  /// `box` and `pixels` (not 0: the region's, at least one; of the box's size): of the maps.
  RegionFeatures measure(const cv::Rect& box, const cv::Mat1b& pixels, size_t level);

 private:
  const ForegroundMaps& maps_;
  const std::optional<GroundPlane>& ground_;
  double scale_;                ///< pixels of the image per pixel of the maps
  cv::Mat1f outside_, inside_;  ///< memory of distances that is used again
};

}  // namespace redbee
