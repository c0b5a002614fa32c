#include "redbee/detection/parallax/propagated_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "redbee/detection/parallax/evidence_kernels.hpp"

namespace redbee {
namespace {

Propagation propagationBy(const ParallaxParameters& parameters, float step, const Eigen::Matrix3d& ground) {
  // Averaging reduces the variance of a single vector to about half.
  constexpr double kAveragedVariance = 0.5;
  const double half2 = parameters.evidence_sigmas * parameters.evidence_sigmas;
  Propagation by{};
  by.step = step;
  const Eigen::Matrix3f back = ground.inverse().cast<float>();
  for (int i = 0; i < 9; ++i) by.back[i] = back(i / 3, i % 3);
  by.half2 = static_cast<float>(half2);
  by.rate = static_cast<float>(parameters.evidence_rate);
  by.motion_half2 = static_cast<float>(kAveragedVariance * half2);
  return by;
}

}  // namespace

void PropagatedEvidence::reset() { moving_.release(); }

void PropagatedEvidence::update(const FrameEvidence& now, const Eigen::Matrix3d& ground,
                                const cv::Mat1b& unknown) {
  const cv::Mat2f& residual = now.normalized_residual;
  const Propagation by = propagationBy(parameters_, now.step, ground);
  std::swap(previous_, moving_);
  const bool has_previous = !previous_.empty();
  moving_.create(residual.size());
  motion_.create(residual.size());
  const size_t values = 2 * static_cast<size_t>(residual.cols);
  places_.resize(values);
  sums_.resize(values + 4);
  mean_residual_.resize(values);
  // Mirrored beyond the border.
  const int last = residual.rows - 1, inside = std::min(1, last);
  for (int y = 0; y <= last; ++y) {
    const float* above = residual.ptr<float>(y == 0 ? inside : y - 1);
    const float* below = residual.ptr<float>(y == last ? last - inside : y + 1);
    propagateRow(by, {y,
                      static_cast<size_t>(residual.cols),
                      now.flow.ptr<float>(y),
                      {above, residual.ptr<float>(y), below},
                      has_previous ? previous_.ptr<float>() : nullptr,
                      residual.rows,
                      unknown[y],
                      places_.data(),
                      sums_.data(),
                      mean_residual_.data(),
                      moving_.ptr<float>(y),
                      motion_[y]});
  }
}

}  // namespace redbee
