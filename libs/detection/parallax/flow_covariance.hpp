// Covariance of dense flow by the image's texture: along an edge the flow is not observed (aperture problem).
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/parallax/structure_tensor.hpp"

namespace redbee {

/// Covariances of all pixels of an image, interpolated from a smaller map.
class FlowCovariance {
 public:
  FlowCovariance(const cv::Mat3f& map, cv::Size size);
  /// The same variance everywhere, in all directions.
  FlowCovariance(cv::Size size, float variance);

  cv::Size size() const { return size_; }
  Symmetric2f operator()(int y, int x) const;
  float largest(int y, int x) const { return largestEigenvalue((*this)(y, x)); }

  /// A row of pixels lies between two rows of the map; these are interpolated along the row, xx, xy and yy
  /// apart.
  struct Rows {
    const float* upper[3];
    const float* lower[3];
    float upper_weight, lower_weight;
  };
  /// Valid until the next call; fast for rows in order.
  Rows rows(int y);

 private:
  struct InterpolatedRow {
    int row = -1;
    std::vector<float> values;  ///< xx, xy, yy
  };
  Symmetric2f along(int row, size_t column) const;
  InterpolatedRow& interpolated(int row);

  cv::Mat3f map_;
  cv::Size size_;
  std::vector<int32_t> left_, right_;  ///< of each column: offsets of its neighbours in a row of the map
  std::vector<float> right_weight_;
  InterpolatedRow kept_[2];
};

struct FlowNoise {
  double sigma_px;      ///< px at full size, of the flow over good texture
  double min_gradient;  ///< grey levels per px, in an image four times smaller: doubles the variance
};

/// Covariance of the flow of one image, by its texture.
class FlowTexture {
 public:
  /// `grey`: `scale` times smaller than the full image. It is reduced to a quarter of the full size, about
  /// the flow's own grid.
  FlowTexture(const cv::Mat1b& grey, double scale);

  /// Covariance [px^2], of grey's size: sigma^2 (I + min_gradient^2 S^-1), S the structure tensor.
  FlowCovariance covariance(const FlowNoise& noise) const;

 private:
  cv::Mat3f gradients_;  ///< S, quarter-size
  cv::Size size_;
  double scale_;
};

}  // namespace redbee
