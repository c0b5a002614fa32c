#include "redbee/node/health.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>
#include <vector>

#include "redbee/bus/build_version.hpp"

namespace redbee {

const char* toString(HealthState state) {
  switch (state) {
    case HealthState::kStarting:
      return "starting";
    case HealthState::kGood:
      return "good";
    case HealthState::kDegraded:
      return "degraded";
    case HealthState::kStopping:
      return "stopping";
    case HealthState::kDead:
      return "dead";
  }
  return "?";
}

std::optional<HealthState> healthStateOf(const std::string& name) {
  for (int8_t number = 0; number <= static_cast<int8_t>(HealthState::kDead); ++number) {
    const auto state = static_cast<HealthState>(number);
    if (name == toString(state)) return state;
  }
  return std::nullopt;
}

void SequenceCounter::note(int32_t sequence) {
  if (!started_) return startAt(sequence);
  if (missing_.erase(sequence) > 0) {
    --lost_;
  } else if (sequence == 0 || sequence < last_ - kReordering) {
    startAt(sequence);
  } else if (sequence > last_) {
    noteHoles(sequence);
    last_ = sequence;
  }
}

void SequenceCounter::startAt(int32_t sequence) {
  started_ = true;
  last_ = sequence;
  missing_.clear();
}

void SequenceCounter::noteHoles(int32_t sequence) {
  lost_ += static_cast<int64_t>(sequence) - last_ - 1;
  missing_.erase(missing_.begin(), missing_.lower_bound(sequence - kReordering));
  for (int32_t hole = std::max(last_ + 1, sequence - kReordering); hole < sequence; ++hole)
    missing_.insert(hole);
}

void MessageRate::note(Duration time) {
  constexpr Duration kReordering = std::chrono::milliseconds(500);
  if (!times_.empty() && time + kReordering < times_.back()) times_.clear();
  times_.insert(std::upper_bound(times_.begin(), times_.end(), time), time);
  if (times_.size() > kWindow) times_.pop_front();
}

double MessageRate::hertz() const {
  if (times_.size() < 2 || times_.back() == times_.front()) return 0;
  return static_cast<double>(times_.size() - 1) * 1e6 /
         static_cast<double>((times_.back() - times_.front()).count());
}

void LatencyWindow::note(double milliseconds) {
  values_.push_back(milliseconds);
  if (values_.size() > kWindow) values_.pop_front();
}

double LatencyWindow::percentile(double fraction) const {
  if (values_.empty()) return 0;
  std::vector<double> sorted(values_.begin(), values_.end());
  const double rank = std::ceil(fraction * static_cast<double>(sorted.size())) - 1;
  const auto at = sorted.begin() +
                  static_cast<std::ptrdiff_t>(std::clamp(rank, 0.0, static_cast<double>(sorted.size() - 1)));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

HealthMonitor::HealthMonitor(std::string process, std::string configuration_hash)
    : process_(std::move(process)), configuration_hash_(std::move(configuration_hash)) {}

void HealthMonitor::noteInput(Duration time) {
  noteReceived(time);
  ++inputs_;
  rate_in_.note(time);
}

void HealthMonitor::noteReceived(Duration time) {
  ++received_;
  newest_time_ = std::max(newest_time_, time);
}

void HealthMonitor::notePublished(Duration time) {
  ++published_;
  rate_out_.note(time);
}

void HealthMonitor::noteWork(double milliseconds) {
  work_.note(milliseconds);
  work_sum_ += milliseconds;
  ++work_count_;
  noteProgress();
}

void HealthMonitor::noteCpu(const CpuTime& time) {
  cpu_.work += time.work;
  cpu_.publishing += time.publishing;
}

void HealthMonitor::setState(HealthState state, const std::string& message) {
  changed_ = changed_ || state != state_ || message != state_message_;
  state_ = state;
  state_message_ = message;
}

void HealthMonitor::setCalibration(const std::string& status) {
  changed_ = changed_ || status != calibration_;
  calibration_ = status;
}

void HealthMonitor::setInputSilence(double seconds) {
  const bool was_timed_out = isInputTimedOut();
  input_silence_s_ = seconds;
  changed_ = changed_ || isInputTimedOut() != was_timed_out;
}

void HealthMonitor::noteIgnored(const std::string& channel, const std::string& what) {
  const auto known = ignored_.find(channel);
  changed_ = changed_ || known == ignored_.end() || !isReported(known->second);
  ignored_[channel] = {what, newest_time_};
}

bool HealthMonitor::consumeChange() { return std::exchange(changed_, false); }

int64_t HealthMonitor::lost() const {
  int64_t sum = lost_otherwise_;
  for (const auto& [channel, counter] : sequences_) sum += counter.lost();
  return sum;
}

int64_t HealthMonitor::lost(const std::string& channel) const {
  const auto it = sequences_.find(channel);
  return it == sequences_.end() ? 0 : it->second.lost();
}

void HealthMonitor::describeState(process_health_t& message) const {
  message.state = static_cast<int8_t>(state_);
  message.message = state_message_;
  message.rate_in = rate_in_.hertz();
  message.rate_out = rate_out_.hertz();
  if (state_ != HealthState::kStopping) describeInput(message);
}

void HealthMonitor::describeInput(process_health_t& message) const {
  const auto degrade = [&](const std::string& reason) {
    if (state_ == HealthState::kGood) message.state = static_cast<int8_t>(HealthState::kDegraded);
    message.message += (message.message.empty() ? "" : "; ") + reason;
  };
  if (isInputTimedOut()) {
    message.rate_in = message.rate_out = 0;
    if (!explains_silence_) message.message.clear();
    degrade("no input for " + std::to_string(static_cast<int64_t>(input_silence_s_)) + " s");
  }
  for (const auto& [channel, ignored] : ignored_) {
    if (isReported(ignored)) degrade(channel + ": " + ignored.what);
  }
}

process_health_t HealthMonitor::nextMessage() {
  process_health_t message{};
  message.utime = newest_time_.count();
  message.process = process_;
  message.pid = static_cast<int32_t>(getpid());
  message.sequence = sequence_++;
  describeState(message);
  message.latency_median = latencyMedian();
  message.latency_p99 = latencyP99();
  message.work_mean = work_count_ > 0 ? work_sum_ / static_cast<double>(work_count_) : 0;
  message.work_median = workMedian();
  message.work_p99 = workP99();
  message.received = received_;
  message.published = published_;
  message.skipped = skipped_;
  message.lost = lost();
  message.damaged = damaged_;
  message.late = late_;
  message.resident = residentBytes();
  message.version = buildVersion();
  message.configuration = configuration_hash_;
  message.calibration = calibration_;
  return message;
}

int64_t residentBytes() {
  std::ifstream statm("/proc/self/statm");
  int64_t total_pages = 0;
  int64_t resident_pages = 0;
  if (!(statm >> total_pages >> resident_pages)) return 0;
  return resident_pages * sysconf(_SC_PAGESIZE);
}

}  // namespace redbee
