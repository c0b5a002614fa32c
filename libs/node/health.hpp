// Health of a process: state, counters, rates and latencies for PROCESS_HEALTH.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "redbee/geometry/time.hpp"
#include "redbee/process_health_t.hpp"

namespace redbee {

/// Counts the messages missing from one publisher's sequence numbers (0, 1, 2, ...). A late message is no
/// longer counted as missing; a duplicate is ignored; a number of 0, or one more than `kReordering` behind,
/// is a restart of the publisher, not a loss.
class SequenceCounter {
 public:
  static constexpr int32_t kReordering = 32;

  void note(int32_t sequence);
  /// Another publisher: its next number is not compared with the last.
  void restart() { started_ = false; }
  int64_t lost() const { return lost_; }

 private:
  void startAt(int32_t sequence);
  void noteHoles(int32_t sequence);

  int64_t lost_ = 0;
  int32_t last_ = -1;
  bool started_ = false;
  std::set<int32_t> missing_;  ///< recent ones, which may still arrive late
};

/// Rate of messages by the times inside them, over the newest `kWindow`.
class MessageRate {
 public:
  static constexpr size_t kWindow = 120;

  /// A time that was set back, by more than messages are reordered, restarts the window.
  void note(Duration time);
  /// Hz; 0 before the second message.
  double hertz() const;

 private:
  std::deque<Duration> times_;
};

/// Median and 99th percentile of the newest `kWindow` values.
class LatencyWindow {
 public:
  static constexpr size_t kWindow = 480;

  void note(double milliseconds);
  /// The value at or below which this fraction of the window lies (0.5: the median); 0 while the window is
  /// empty.
  double percentile(double fraction) const;

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
/// std::nullopt if `name` is not the name of a state.
std::optional<HealthState> healthStateOf(const std::string& name);

/// Processor time of a frame [ms]: until its result was computed (decoding included), and to encode and
/// publish it.
struct CpuTime {
  double work = 0;
  double publishing = 0;
};

/// Collects the contents of process_health_t. One per node; not thread-safe. Times are those inside the
/// messages, since the epoch of their clock.
class HealthMonitor {
 public:
  /// `configuration_hash`: configurationHash() of the process's configuration.
  HealthMonitor(std::string process, std::string configuration_hash);

  /// A message of the input that drives the process (for most processes: a frame).
  void noteInput(Duration time);
  /// Any other message.
  void noteReceived(Duration time);
  void notePublished(Duration time);
  void noteSkipped(int64_t frames = 1) { skipped_ += frames; }
  void noteDamaged(int64_t messages = 1) { damaged_ += messages; }
  void noteLate(int64_t inputs = 1) { late_ += inputs; }
  /// Lost messages that sequence numbers do not show.
  void noteLost(int64_t messages) { lost_otherwise_ += messages; }
  /// `sequence` of a message on `channel`; missing numbers count as lost messages.
  void noteSequence(const std::string& channel, int32_t sequence) { sequences_[channel].note(sequence); }
  /// The messages on `channel` come from another publisher from now on.
  void restartSequence(const std::string& channel) { sequences_[channel].restart(); }
  /// Something on `channel` was ignored, such as a second source. For kIgnoredReported after each the state
  /// is degraded and the message says so.
  void noteIgnored(const std::string& channel, const std::string& what);
  static constexpr Duration kIgnoredReported = std::chrono::seconds(5);
  /// From receiving the driving input to publishing the result [ms].
  void noteLatency(double milliseconds) { latency_.note(milliseconds); }
  /// Wall time of processing one frame, without waiting [ms].
  void noteWork(double milliseconds);
  void noteCpu(const CpuTime& time);
  /// `callback` is called after each frame and by noteProgress(): several in a row may take longer than a
  /// pass of the main loop should.
  void onProgress(std::function<void()> callback) { on_progress_ = std::move(callback); }
  /// Of a process without frames of its own: a message has been handled.
  void noteProgress() {
    if (on_progress_) on_progress_();
  }

  /// `message`: the reason in one line, empty for a good state. A change of either is published immediately.
  void setState(HealthState state, const std::string& message = "");
  /// Result of CalibrationMonitor. A change is published immediately.
  void setCalibration(const std::string& status);
  /// Time since the last driving input [s, wall clock]. From kInputTimeout_s on the state is degraded and the
  /// rates, which are by message time, are reported as zero.
  void setInputSilence(double seconds);
  static constexpr double kInputTimeout_s = 1.0;
  /// The process reads its input from a device: a degraded state says why there is none, and is kept.
  void explainsSilence() { explains_silence_ = true; }
  HealthState state() const { return state_; }
  /// Returns true once after each change, and once after construction.
  bool consumeChange();

  /// Messages of the driving input.
  int64_t inputs() const { return inputs_; }
  int64_t received() const { return received_; }
  int64_t published() const { return published_; }
  int64_t skipped() const { return skipped_; }
  int64_t damaged() const { return damaged_; }
  int64_t late() const { return late_; }
  int64_t lost() const;
  /// Of one channel; 0 before its first message.
  int64_t lost(const std::string& channel) const;
  double latencyMedian() const { return latency_.percentile(0.5); }
  double latencyP99() const { return latency_.percentile(0.99); }
  double workMedian() const { return work_.percentile(0.5); }
  double workP99() const { return work_.percentile(0.99); }

  /// Sum over all frames.
  const CpuTime& cpu() const { return cpu_; }
  const std::string& process() const { return process_; }

  /// The message to publish now; each has the next sequence number.
  process_health_t nextMessage();

 private:
  bool isInputTimedOut() const { return input_silence_s_ >= kInputTimeout_s; }
  void describeState(process_health_t& message) const;
  /// Adds what is missing or ignored.
  void describeInput(process_health_t& message) const;
  struct Ignored {
    std::string what;
    Duration newest_time{};  ///< the newest message time then
  };
  bool isReported(const Ignored& ignored) const {
    return newest_time_ - ignored.newest_time < kIgnoredReported;
  }

  std::string process_;
  std::string configuration_hash_;
  std::string calibration_;
  HealthState state_ = HealthState::kStarting;
  std::string state_message_;
  bool changed_ = true;
  Duration newest_time_{};
  int32_t sequence_ = 0;
  double input_silence_s_ = 0;
  bool explains_silence_ = false;
  int64_t inputs_ = 0;
  int64_t received_ = 0;
  int64_t published_ = 0;
  int64_t skipped_ = 0;
  int64_t damaged_ = 0;
  int64_t late_ = 0;
  int64_t lost_otherwise_ = 0;
  std::map<std::string, SequenceCounter> sequences_;
  std::map<std::string, Ignored> ignored_;  ///< by channel
  MessageRate rate_in_;
  MessageRate rate_out_;
  LatencyWindow latency_;
  LatencyWindow work_;
  double work_sum_ = 0;
  int64_t work_count_ = 0;
  CpuTime cpu_;
  std::function<void()> on_progress_;
};

/// Resident memory of this process [bytes]; 0 if /proc is not available.
int64_t residentBytes();

}  // namespace redbee
