// How a process fares, in numbers that a ground station can read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "redbee/process_health_t.hpp"

namespace redbee {

/// Counts the holes in one publisher's sequence numbers (0, 1, 2, ...). A number that comes late takes its
/// hole back; one that comes twice counts for nothing; a publisher that starts again at 0, or falls back
/// further than `kReordering`, is a new beginning and no loss.
class SequenceCounter {
 public:
  static constexpr int32_t kReordering = 32;

  void note(int32_t sequence);
  int64_t lost() const { return lost_; }

 private:
  void startAt(int32_t sequence);
  void noteHoles(int32_t sequence);

  int64_t lost_ = 0;
  int32_t last_ = -1;
  bool started_ = false;
  std::set<int32_t> missing_;  ///< recent holes, which a late message may still fill
};

/// Rate of events by the times in their messages, over the newest `kWindow` of them.
class MessageRate {
 public:
  static constexpr size_t kWindow = 120;

  /// A time that runs backwards starts the window anew.
  void note(int64_t utime);
  /// Hz; 0 before the second event.
  double hertz() const;

 private:
  std::deque<int64_t> utimes_;
};

/// Median and 99th percentile of the newest `kWindow` values.
class LatencyWindow {
 public:
  static constexpr size_t kWindow = 480;

  void note(double milliseconds);
  /// `share`: 0.5 for the median. The value at or below which this share of the window lies; 0 while it is
  /// empty.
  double percentile(double share) const;

 private:
  std::deque<double> values_;
};

enum class HealthState : int8_t {
  kStarting = process_health_t::STARTING,
  kGood = process_health_t::GOOD,
  kDegraded = process_health_t::DEGRADED,
  kStopping = process_health_t::STOPPING,
  kDead = process_health_t::DEAD,
};
/// "starting", "good", "degraded", "stopping", "dead".
const char* toString(HealthState state);
/// Nothing for a word that names no state.
std::optional<HealthState> healthStateOf(const std::string& name);

/// Processor time [ms] that a frame took: until its answer was known (decoding included), and to make it into
/// messages and publish them.
struct CpuTime {
  double work = 0;
  double publishing = 0;
};

/// Collects what process_health_t tells. One per node, used by its one thread.
class HealthMonitor {
 public:
  /// `configuration_hash`: configurationHash() of what the process runs with.
  HealthMonitor(std::string process, std::string configuration_hash);

  /// A message of the input that drives the process (for most: the frames).
  void noteInput(int64_t utime);
  /// Any other message.
  void noteReceived(int64_t utime);
  void notePublished(int64_t utime);
  void noteSkipped(int64_t frames = 1) { skipped_ += frames; }
  void noteDamaged(int64_t messages = 1) { damaged_ += messages; }
  void noteLate(int64_t inputs = 1) { late_ += inputs; }
  /// Messages that no sequence number tells of.
  void noteLost(int64_t messages) { lost_otherwise_ += messages; }
  /// `sequence` of a message on `channel`: holes count as lost messages.
  void noteSequence(const std::string& channel, int32_t sequence) { sequences_[channel].note(sequence); }
  /// From taking the driving input to publishing what came of it [ms].
  void noteLatency(double milliseconds) { latency_.note(milliseconds); }
  /// Wall time of the work on one frame, waiting left out [ms].
  void noteWork(double milliseconds);
  void noteCpu(const CpuTime& share);

  /// `message`: one line that says why, empty when all is well. A change of either is a change to tell at
  /// once.
  void setState(HealthState state, const std::string& message = "");
  /// Whether the calibration fits the flight, in words. A change of it is a change to tell at once.
  void setCalibration(const std::string& verdict);
  /// The driving input has been away for so long [s, of the reader's clock]. From kQuietAfter_s on that is
  /// what the health says, and the rates, which know message time only, are zero.
  void setQuiet(double seconds);
  static constexpr double kQuietAfter_s = 1.0;
  HealthState state() const { return state_; }
  /// True once after each change, and once after construction.
  bool takeChange();

  /// Messages of the driving input.
  int64_t inputs() const { return inputs_; }
  int64_t received() const { return received_; }
  int64_t published() const { return published_; }
  int64_t skipped() const { return skipped_; }
  int64_t damaged() const { return damaged_; }
  int64_t late() const { return late_; }
  int64_t lost() const;
  /// Of one channel; 0 for one that never spoke.
  int64_t lost(const std::string& channel) const;
  double latencyMedian() const { return latency_.percentile(0.5); }
  double latencyP99() const { return latency_.percentile(0.99); }
  double workMedian() const { return work_.percentile(0.5); }
  double workP99() const { return work_.percentile(0.99); }

  /// Sum over all frames [ms].
  const CpuTime& cpu() const { return cpu_; }
  const std::string& process() const { return process_; }

  /// The message to publish now; each has the next sequence number.
  process_health_t nextMessage();

 private:
  bool isQuiet() const { return quiet_s_ >= kQuietAfter_s; }
  void describeState(process_health_t& message) const;

  std::string process_;
  std::string configuration_hash_;
  std::string calibration_;
  HealthState state_ = HealthState::kStarting;
  std::string state_message_;
  bool changed_ = true;
  int64_t newest_utime_ = 0;
  int32_t sequence_ = 0;
  double quiet_s_ = 0;
  int64_t inputs_ = 0;
  int64_t received_ = 0;
  int64_t published_ = 0;
  int64_t skipped_ = 0;
  int64_t damaged_ = 0;
  int64_t late_ = 0;
  int64_t lost_otherwise_ = 0;
  std::map<std::string, SequenceCounter> sequences_;
  MessageRate rate_in_;
  MessageRate rate_out_;
  LatencyWindow latency_;
  LatencyWindow work_;
  double work_sum_ = 0;
  int64_t work_count_ = 0;
  CpuTime cpu_;
};

/// Resident memory of this process [bytes]; 0 where /proc does not tell.
int64_t residentBytes();

}  // namespace redbee
