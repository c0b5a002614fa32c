#include "redbee/detection/parallax/flow_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/parallax/evidence_kernels.hpp"

namespace redbee {
namespace {

SmoothFlow smoothFlow(const HomographyFlow& flow) {
  const auto& a = flow.affine;
  return {{flow.middle[0], flow.middle[1]},
          flow.unit,
          {a(0, 0), a(0, 1), a(0, 2), a(1, 0), a(1, 1), a(1, 2)},
          {flow.perspective[0], flow.perspective[1]}};
}

/// residualRow() for any segment.
void residualRowAlong(const ParallaxSegment& segment, const HomographyFlow& error, const ResidualRow& row) {
  for (size_t i = 0; i < row.width; ++i) {
    const cv::Vec2f pixel(static_cast<float>(i), static_cast<float>(row.y)),
        back(row.flow[2 * i], row.flow[2 * i + 1]);
    const auto entry = [&](size_t k) {
      return row.upper[k][i] * row.upper_weight + row.lower[k][i] * row.lower_weight;
    };
    const Symmetric2f noise(entry(0), entry(1), entry(2));
    const cv::Vec2f forth = -back - error.at(pixel[0], pixel[1]);
    const ParallaxSegment::Residual found = segment.residual(pixel + back, forth, noise);
    const bool is_known = row.unknown[i] == 0;
    row.squared[i] = is_known ? std::min(found.squaredMahalanobis(), kMostSquaredResidual) : kNotCompared;
    for (int k = 0; k < 2; ++k) {
      row.normalized_residual[2 * i + static_cast<size_t>(k)] = is_known ? found.normalized_residual[k] : 0;
      row.nearest[2 * i + static_cast<size_t>(k)] = found.nearest[k];
    }
    row.speed[2 * i] = std::sqrt(forth.dot(forth));
    row.speed[2 * i + 1] = largestEigenvalue(noise);
  }
}

}  // namespace

void FlowComparison::compareRow(int y, const uint8_t* unknown, const Row& to) {
  const FlowCovariance::Rows noise = noise_.rows(y);
  const ResidualRow row{y,
                        static_cast<size_t>(flow_.cols),
                        flow_.ptr<float>(y),
                        {noise.upper[0], noise.upper[1], noise.upper[2]},
                        {noise.lower[0], noise.lower[1], noise.lower[2]},
                        noise.upper_weight,
                        noise.lower_weight,
                        unknown,
                        to.normalized_residual->val,
                        to.squared,
                        to.nearest->val,
                        to.speed->val};
  if (const std::optional<cv::Vec3f> epipole = motion_.segment.epipole()) {
    residualRow(smoothFlow(motion_.error), epipole->val, motion_.segment.directionVariance(), row);
  } else {
    residualRowAlong(motion_.segment, motion_.error, row);
  }
}

ImagePair FlowComparison::images(const cv::Mat1b& unknown) {
  // Few rows are asked for, so that they are compared once more instead of kept.
  cv::Mat2f scratch(3, flow_.cols);
  cv::Mat1f squared(1, flow_.cols);
  const auto nearest = [=](int y) mutable {
    compareRow(y, unknown[y], {scratch[0], scratch[1], squared[0], scratch[2]});
    return scratch[1];
  };
  return {current_, earlier_, flow_, nearest, motion_.error};
}

}  // namespace redbee
