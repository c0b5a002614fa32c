// Segmentation of the foreground into components.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/parameters.hpp"

namespace redbee {

/// A connected region of the foreground in one frame.
struct Component {
  cv::Rect box;        ///< px
  double area_px = 0;  ///< px^2
  double score = 0;    ///< mean P_FG, 0..1
  double peak = 0;     ///< highest P_FG, 0..1
  /// Mean of ForegroundMaps::residual around it; 1, as of a static scene, if it is not known.
  double residual_around = 1;
  double gain = 1;  ///< mean of ForegroundMaps::gain; 1, no evidence, if it is not known
};

struct ForegroundComponents {
  cv::Size image;
  std::vector<Component> components;
  cv::Rect part;     ///< px, of the image: where `labels` lie
  cv::Mat1w labels;  ///< of the pixels of `part`: index in `components` plus one, 0: none

  /// No more than these can be labelled.
  static constexpr size_t kMost = 65535;
  bool isFull(size_t more = 1) const { return components.size() + more > kMost; }

  /// 0 or 255, of the image's size: the pixels of all components, or of those that are kept.
  cv::Mat1b mask() const;
  cv::Mat1b mask(const std::vector<size_t>& kept) const;
  /// 255 at the pixels of one component, of its box's size.
  cv::Mat1b pixelsOf(size_t index) const;
};

/// Those of ForegroundMaps that components are asked about; each may be empty.
struct ComponentMaps {
  cv::Mat1f gain{};
  cv::Mat1f residual{};
  cv::Mat1f moving{};
};

/// Components that exceed `weak_threshold` somewhere. Each reaches as far as P_FG exceeds `extent_threshold`
/// and the lower of 0.3 of the component's own peak and half of `threshold` (after opening, closing and a
/// minimum area): what belongs to a weak object is a halo around a strong one. `probability`: P_FG * 255.
/// `unknown`: not 0 where there is no statement.
ForegroundComponents findComponents(const cv::Mat1b& probability, const cv::Mat1b& unknown,
                                    const ObjectParameters& parameters, const ComponentMaps& maps = {});

/// Divides a component among objects that it covers: each pixel goes to the box whose centre is nearest in
/// units of the box's sides. The part of the first box takes the component's place, the others are appended.
/// `boxes`: px, not empty.
void splitComponent(ForegroundComponents& found, size_t index, const std::vector<cv::Rect2d>& boxes);

}  // namespace redbee
