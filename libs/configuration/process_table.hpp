// The table of all processes: what scripts, tests and `redbee stack` know about them comes from here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace redbee {

/// Up to four keys of one section of the configuration.
class KeyList {
 public:
  constexpr KeyList() = default;
  template <typename... Keys>
  constexpr KeyList(std::string_view first, Keys... others)
      : keys_{first, others...}, count_(1 + sizeof...(others)) {}
  constexpr const std::string_view* begin() const { return keys_.data(); }
  constexpr const std::string_view* end() const { return keys_.data() + count_; }
  constexpr bool empty() const { return count_ == 0; }

 private:
  std::array<std::string_view, 4> keys_{};
  size_t count_ = 0;
};

struct ProcessDescription {
  std::string_view name;  ///< for people and scripts; a program of its own is called redbee-<name>
  /// Subcommand of `redbee` that runs it; empty for a program of its own.
  std::string_view subcommand{};
  KeyList publishes{};                 ///< channels, by their keys in the section `channels`
  KeyList waits_for{};                 ///< channels whose message of the same frame it waits for
  KeyList waits_for_previous{};        ///< channels whose message of the frame before it waits for
  std::string_view patience{};         ///< key in the section `waits`: how long
  int64_t memory_limit = 600'000'000;  ///< bytes of data, enforced by scripts/limited
  int priority = 10;                   ///< supervisor starts the lower first and stops it last
  int niceness = 0;                    ///< as nice(1) takes it
  bool has_configuration = true;       ///< takes --config
  bool keeps_state = false;            ///< takes --state-dir, for what survives a restart
  bool is_recorder = false;  ///< takes --out, starts where REDBEE_RECORD asks for it, may end by itself
};

inline constexpr ProcessDescription kImuIntegration = [] {
  ProcessDescription process{"imu-integration"};
  process.publishes = {"inertial_homography", "filter_snapshot"};
  process.waits_for_previous = {"fused_homography"};
  process.patience = "inertial_s";
  return process;
}();

inline constexpr ProcessDescription kVisualHomography = [] {
  ProcessDescription process{"visual-homography"};
  process.publishes = {"visual_homography"};
  process.waits_for = {"inertial_homography"};
  process.patience = "visual_s";
  return process;
}();

inline constexpr ProcessDescription kHomographyFusion = [] {
  ProcessDescription process{"homography-fusion"};
  process.publishes = {"fused_homography", "warm_start"};
  process.waits_for = {"inertial_homography", "visual_homography"};
  process.patience = "fusion_s";
  return process;
}();

inline constexpr ProcessDescription kMotionSegmentation = [] {
  ProcessDescription process{"motion-segmentation"};
  process.publishes = {"foreground", "detections", "overlay"};
  process.waits_for = {"fused_homography"};
  process.patience = "segmentation_s";
  process.memory_limit = 1'000'000'000;
  process.keeps_state = true;
  return process;
}();

inline constexpr ProcessDescription kWatch = [] {
  ProcessDescription process{"watch", "watch"};
  process.memory_limit = 300'000'000;
  process.priority = 1;
  return process;
}();

inline constexpr ProcessDescription kRecord = [] {
  ProcessDescription process{"record", "record"};
  process.memory_limit = 400'000'000;
  process.priority = 20;
  process.niceness = 5;
  process.has_configuration = false;
  process.is_recorder = true;
  return process;
}();

/// The processes that a frame passes through, in the order of the work: each is a node and a program.
inline constexpr std::array kStages{&kImuIntegration, &kVisualHomography, &kHomographyFusion,
                                    &kMotionSegmentation};
/// The processes beside them: subcommands of `redbee`.
inline constexpr std::array kCompanions{&kWatch, &kRecord};

constexpr bool everyWaitHasItsPatience() {
  for (const ProcessDescription* stage : kStages) {
    const bool waits = !stage->waits_for.empty() || !stage->waits_for_previous.empty();
    if (waits == stage->patience.empty()) return false;
  }
  return true;
}
static_assert(everyWaitHasItsPatience());

/// redbee-<name>: the program, and what PROCESS_HEALTH calls the process.
inline std::string programName(const ProcessDescription& process) {
  return "redbee-" + std::string(process.name);
}

}  // namespace redbee
