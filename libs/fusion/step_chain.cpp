#include "redbee/fusion/step_chain.hpp"

#include <algorithm>

namespace redbee {
namespace {

constexpr std::size_t kMaxFrames = 32;

}  // namespace

void StepChain::append(CameraTime time, const Estimate& step) {
  frames_.push_back({time, step});
  if (frames_.size() > kMaxFrames) frames_.pop_front();
}

/// H^{k-1:k} = H^{s:k} (H^{s:k-1})^-1.
std::optional<Estimate> StepChain::stepOf(CameraTime time, const Estimate& since) const {
  const std::optional<Estimate> known = this->since(time);
  if (!known) return std::nullopt;
  if (time == newest()) return Estimate{since.H, symmetric(since.P)};
  if (!isUsable(known->H)) return std::nullopt;
  return remainder(since, *known);
}

std::optional<Estimate> StepChain::since(CameraTime time) const {
  const auto start =
      std::find_if(frames_.begin(), frames_.end(), [&](const Frame& frame) { return frame.time == time; });
  if (start == frames_.end()) return std::nullopt;
  Estimate known = identityEstimate();
  for (auto frame = start + 1; frame != frames_.end(); ++frame) known = composed(frame->step, known);
  return known;
}

}  // namespace redbee
