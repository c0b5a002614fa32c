// The table of all processes, the single source for scripts, tests and `redbee stack`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace redbee {

/// Up to six keys of one section of the configuration.
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
  std::array<std::string_view, 6> keys_{};
  size_t count_ = 0;
};

struct ProcessDescription {
  std::string_view name;  ///< for people and scripts; a program of its own is called redbee-<name>
  /// Subcommand of `redbee` that runs it; empty for a program of its own.
  std::string_view subcommand{};
  KeyList publishes{};                 ///< channels, by their keys in the section `channels`
  KeyList waits_for{};                 ///< channels whose message of the same frame it waits for
  KeyList waits_for_previous{};        ///< channels whose message of the previous frame it waits for
  std::string_view timeout{};          ///< key of its timeout in the section `waits`
  int64_t memory_limit = 600'000'000;  ///< bytes of data, enforced by scripts/limited
  int priority = 10;                   ///< supervisor starts the lower first and stops it last
  int niceness = 0;                    ///< as for nice(1)
  bool has_configuration = true;       ///< takes --config
  bool keeps_state = false;            ///< takes --state-dir, for what survives a restart
  bool is_recorder = false;            ///< takes --out, runs only if REDBEE_RECORD is set, may exit by itself
};

inline constexpr ProcessDescription kImuIntegration = [] {
  ProcessDescription process{"imu-integration"};
  process.publishes = {"inertial_homography", "filter_snapshot"};
  process.waits_for_previous = {"fused_homography"};
  process.timeout = "inertial_s";
  return process;
}();

inline constexpr ProcessDescription kVisualHomography = [] {
  ProcessDescription process{"visual-homography"};
  process.publishes = {"visual_homography"};
  process.waits_for = {"inertial_homography"};
  process.timeout = "visual_s";
  return process;
}();

inline constexpr ProcessDescription kHomographyFusion = [] {
  ProcessDescription process{"homography-fusion"};
  process.publishes = {"fused_homography", "warm_start"};
  process.waits_for = {"inertial_homography", "visual_homography"};
  process.timeout = "fusion_s";
  return process;
}();

inline constexpr ProcessDescription kMotionSegmentation = [] {
  ProcessDescription process{"motion-segmentation"};
  process.publishes = {"foreground", "detections", "overlay"};
  process.waits_for = {"fused_homography"};
  process.timeout = "segmentation_s";
  process.memory_limit = 1'000'000'000;
  process.keeps_state = true;
  return process;
}();

inline constexpr ProcessDescription kCamera = [] {
  ProcessDescription process{"camera"};
  process.publishes = {"camera"};
  process.priority = 5;
  return process;
}();

inline constexpr ProcessDescription kAutopilot = [] {
  ProcessDescription process{"autopilot"};
  process.publishes = {"imu", "altimeter", "pose", "gimbal", "lens", "autopilot_clock"};
  process.memory_limit = 300'000'000;
  process.priority = 5;
  return process;
}();

/// The ground station in the browser.
inline constexpr ProcessDescription kServe = [] {
  ProcessDescription process{"serve"};
  process.memory_limit = 800'000'000;  // with the stacks of its threads, one a connection
  process.priority = 20;
  process.niceness = 10;
  return process;
}();

inline constexpr ProcessDescription kGeolocation = [] {
  ProcessDescription process{"geolocation"};
  process.publishes = {"targets"};
  process.waits_for = {"detections"};
  process.memory_limit = 300'000'000;
  process.keeps_state = true;
  return process;
}();

inline constexpr ProcessDescription kGroundLink = [] {
  ProcessDescription process{"ground-link"};
  process.memory_limit = 300'000'000;
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

/// The processing stages, in order; each is a node and a program.
inline constexpr std::array kStages{&kImuIntegration, &kVisualHomography, &kHomographyFusion,
                                    &kMotionSegmentation};
/// The programs that fly only where they are configured (drivers.hpp): drivers of sensors, what places
/// targets on the ground and tells others of them, and the ground station's server.
inline constexpr std::array kDrivers{&kCamera, &kAutopilot, &kGeolocation, &kGroundLink, &kServe};
/// The other processes: subcommands of `redbee`.
inline constexpr std::array kSupportProcesses{&kWatch, &kRecord};

constexpr bool everyWaitHasATimeout() {
  for (const ProcessDescription* stage : kStages) {
    const bool waits = !stage->waits_for.empty() || !stage->waits_for_previous.empty();
    if (waits == stage->timeout.empty()) return false;
  }
  return true;
}
static_assert(everyWaitHasATimeout());

/// redbee-<name>: the program, and what PROCESS_HEALTH calls the process.
inline std::string programName(const ProcessDescription& process) {
  return "redbee-" + std::string(process.name);
}

}  // namespace redbee
