// Who a process is, by what the kernel says of it.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace redbee {

struct ProcessIdentity {
  pid_t parent = 0;
  int64_t start_ticks = 0;  ///< since the system started: tells a process from a later one of its number
  std::chrono::milliseconds age{0};  ///< since it started
  std::filesystem::path executable;
};

/// std::nullopt if there is no such process, or it belongs to another user.
std::optional<ProcessIdentity> identityOf(pid_t pid);

/// Of a process's main thread.
struct Scheduling {
  bool is_runnable = false;         ///< it runs, or waits for a processor
  std::chrono::nanoseconds ran{0};  ///< since its start
};

/// std::nullopt if there is no such process, or a kernel that does not say (some print zeros).
std::optional<Scheduling> schedulingOf(pid_t pid);

}  // namespace redbee
