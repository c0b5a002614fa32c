// Collects the results of a run from its messages and writes them to a RunFolder, for stacks in this process
// or in others over LCM.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "processes/redbee/detect/process_usage.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/node/health.hpp"
#include "redbee/process_health_t.hpp"
#include "redbee/results/run_folder.hpp"

namespace redbee {

/// Prepares the folder for a new run. Throws InputError if it cannot be written.
class ResultCollector {
 public:
  ResultCollector(Bus& bus, const Channels& channels, std::filesystem::path folder);

  /// Number of frames whose FOREGROUND message has arrived.
  int64_t frames() const { return static_cast<int64_t>(status_.size()); }
  /// Those of them whose image was one.
  int64_t framesWithImage() const;
  /// Those with a mask to trust.
  int64_t trustedFrames() const;
  /// The latest health message of each process.
  const std::map<std::string, process_health_t>& health() const { return health_; }

  /// `wall_s`: duration of the run. `usage`: of the process that ran the whole stack; std::nullopt for
  /// several processes, and then resident memory is the sum over their health messages.
  void writeTables(double wall_s, const std::optional<ProcessUsage>& usage) const;

 private:
  void onForeground(const foreground_t& message);
  void onFused(const fused_homography_t& message);
  void writeDetections() const;
  void writeHomographies() const;

  RunFolder run_;
  std::map<int64_t, int8_t> status_;  ///< of each frame's foreground
  std::map<int64_t, detections_t> detections_;
  std::map<int64_t, fused_homography_t> homographies_;  ///< without their sample points
  std::map<std::string, process_health_t> health_;
  SequenceCounter foreground_sequence_;
  SequenceCounter fused_sequence_;
  int64_t damaged_ = 0;
  std::string first_failure_;  ///< of writing a map; thrown by writeTables(), as handlers must not throw
  std::vector<Subscription> subscriptions_;
};

}  // namespace redbee
