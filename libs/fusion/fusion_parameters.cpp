#include "redbee/fusion/fusion_parameters.hpp"

#include <algorithm>

namespace redbee {

FusionParameters::FusionParameters() {
  paper_Q << 1e-2, 1e-2, 1, 1e-2, 1e-2, 1, 1e-2, 1e-2;
  paper_P0 << 1e-3, 1e-3, 1e-4, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3;
}

double visualNoiseRatio(const VisualInput& visual) {
  return 1.0 + static_cast<double>(visual.outliers) / std::max(1, visual.inliers);
}

Matrix8d measurementCovariance(const VisualInput& visual, const FusionParameters& parameters) {
  return parameters.visual_inflation * visualNoiseRatio(visual) * visual.covariance;
}

}  // namespace redbee
