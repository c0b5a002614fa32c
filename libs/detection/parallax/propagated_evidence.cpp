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
                                const cv::Mat1b& unknown, SpareMaps& spare) {
  const cv::Size size = now.flow.size();
  const Propagation by = propagationBy(parameters_, now.step, ground);
  const bool has_previous = !moving_.empty();
  cv::Mat4f& moving = spare.ofSize(size);
  motion_.create(size);
  const size_t values = 2 * static_cast<size_t>(size.width);
  places_.resize(values);
  sums_.resize(values + 4);
  mean_residual_.resize(values);
  // Mirrored beyond the border.
  const auto residual = [&](int y) { return now.residual(y)->val; };
  const int last = size.height - 1, inside = std::min(1, last);
  for (int y = 0; y <= last; ++y) {
    const float* below = residual(y == last ? last - inside : y + 1);
    const float* above = residual(y == 0 ? inside : y - 1);
    propagateRow(by, {y,
                      static_cast<size_t>(size.width),
                      now.flow.ptr<float>(y),
                      {above, residual(y), below},
                      has_previous ? moving_.ptr<float>() : nullptr,
                      size.height,
                      unknown[y],
                      places_.data(),
                      sums_.data(),
                      mean_residual_.data(),
                      moving.ptr<float>(y),
                      motion_[y]});
  }
  if (!has_previous) moving_.create(size);
  std::swap(moving_, moving);
}

}  // namespace redbee
