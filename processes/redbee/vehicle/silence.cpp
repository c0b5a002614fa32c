#include "processes/redbee/vehicle/silence.hpp"

#include <algorithm>
#include <utility>

#include "processes/redbee/vehicle/process_identity.hpp"

namespace redbee {
namespace {

constexpr std::chrono::milliseconds kSilent{300};  ///< three signs missed: looked at more closely

}  // namespace

Silence::Clock::duration Silence::waited(pid_t pid, Clock::time_point now, Clock::duration period) {
  if (now < since_ + kSilent) return Clock::duration::zero();
  const auto scheduling = schedulingOf(pid);
  if (!scheduling) return Clock::duration::zero();
  const auto before = std::exchange(ran_, scheduling->ran);
  if (!before || !scheduling->is_runnable) return Clock::duration::zero();
  const Clock::duration waited = period - (scheduling->ran - *before);
  const Clock::duration left = kMostWaited - waited_;
  const Clock::duration credited = std::clamp(waited, Clock::duration::zero(), left);
  waited_ += credited;
  return credited;
}

}  // namespace redbee
