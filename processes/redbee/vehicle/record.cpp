#include "processes/redbee/vehicle/record.hpp"

#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>
#include <vector>

#include "processes/redbee/pages/number.hpp"
#include "processes/redbee/vehicle/recording_queue.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/bus/socket_drops.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/split_log.hpp"
#include "redbee/node/health.hpp"
#include "redbee/node/heartbeat.hpp"
#include "redbee/node/node.hpp"

namespace redbee {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int64_t kQueueBytes = int64_t{100} << 20;
constexpr std::chrono::milliseconds kSyncPeriod{100};
constexpr std::chrono::milliseconds kHealthPeriod{1000};
constexpr std::chrono::seconds kStopTimeout{5};
constexpr int kPollTimeout_ms = 50;
constexpr uint32_t kLongestMessage = 1 << 28;  ///< bytes; LCM refuses longer ones
constexpr int kBatch = 1000;                   ///< messages handled before the time is checked again

std::filesystem::path prefixNow(const std::filesystem::path& folder) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char name[32];
  std::strftime(name, sizeof name, "%Y%m%d_%H%M%S.lcm", &local);
  return folder / name;
}

double freeMegabytes(const std::filesystem::path& folder) {
  return static_cast<double>(std::filesystem::space(folder).available) / kMegabyte;
}

/// Empty while there is room.
std::string shortageOfDisk(const RecordOptions& options) {
  const double free = freeMegabytes(options.out);
  if (free > options.min_free_mb) return "";
  return fmt::format("{:.0f} MB free, {:.0f} MB are kept free", free, options.min_free_mb);
}

class Recorder {
 public:
  explicit Recorder(const RecordOptions& options)
      : options_(options),
        log_(prefixNow(options.out), static_cast<int64_t>(options.split_mb * kMegabyte),
             static_cast<int64_t>(options.min_free_mb * kMegabyte)),
        queue_([this](const ReceivedMessage& message) { write(message); }, kQueueBytes),
        lcm_(options.url) {
    if (!lcm_.good()) throw std::runtime_error("LCM cannot open " + options.url);
    // No limit here: received messages are queued immediately, and the recording queue counts those that do
    // not fit. A function, not a member function: for that GCC 12's -fsanitize=vptr reads an uninitialized
    // register.
    lcm_.subscribeFunction(".*", &Recorder::onReceived, this)->setQueueCapacity(0);
    health_.setState(HealthState::kGood, "recording to " + log_.file().string());
    std::fprintf(stderr, "record: recording to %s\n", log_.file().c_str());
  }

  /// Runs until `stop` or a disk problem. Returns the reason; empty after `stop`.
  std::string run(const std::atomic<bool>& stop) {
    auto next_health = Clock::now();
    Heartbeat heartbeat;
    while (!stop) {
      handle();
      heartbeat.beat();
      if (std::string failure = queue_.failure(); !failure.empty()) return failure;
      if (Clock::now() < next_health) continue;
      next_health += kHealthPeriod;
      if (std::string shortage = shortageOfDisk(options_); !shortage.empty()) return shortage;
      reportLosses();
      publishHealth();
    }
    return "";
  }

  /// When this returns, everything sent before the call is written: our own final message follows it in the
  /// socket, and its receipt is waited for.
  void finish(HealthState state, const std::string& message) {
    std::fprintf(stderr, "record: %s\n", message.c_str());
    health_.setState(state, message);
    final_message_ = publishHealth();
    const auto deadline = Clock::now() + kStopTimeout;
    while (!final_message_received_ && Clock::now() < deadline) handle();
    queue_.close();
    if (queue_.failure().empty()) log_.sync();
    if (lost() > 0) std::fprintf(stderr, "record: %lld messages lost\n", static_cast<long long>(lost()));
  }

 private:
  static void onReceived(const lcm::ReceiveBuffer* received, const std::string& channel, Recorder* recorder) {
    recorder->onMessage(received, channel);
  }

  void onMessage(const lcm::ReceiveBuffer* received, const std::string& channel) {
    // LCM 1.3.1 hands out a packet without a channel as one of size -1.
    if (channel.empty() || received->data_size >= kLongestMessage) return health_.noteDamaged();
    const auto* first = static_cast<const uint8_t*>(received->data);
    ReceivedMessage message{received->recv_utime, channel, {first, first + received->data_size}};
    health_.noteInput(fromUtime(message.utime));
    if (!final_message_.empty() && channel == options_.channel && message.data == final_message_)
      final_message_received_ = true;
    if (!queue_.push(std::move(message))) ++refused_;
  }

  /// In the queue's thread.
  void write(const ReceivedMessage& message) {
    log_.write(message);
    if (Clock::now() - last_sync_ < kSyncPeriod) return;
    log_.sync();
    last_sync_ = Clock::now();
  }

  void handle() {
    for (int i = 0; i < kBatch && lcm_.handleTimeout(i == 0 ? kPollTimeout_ms : 0) > 0; ++i) {
    }
  }

  int64_t lost() const { return refused_ + droppedPackets(); }

  void reportLosses() {
    if (lost() == lost_reported_) return;
    health_.noteLost(lost() - lost_reported_);
    lost_reported_ = lost();
    health_.setState(HealthState::kDegraded, "messages lost: " + std::to_string(lost_reported_));
  }

  std::vector<uint8_t> publishHealth() {
    std::vector<uint8_t> message = encodeMessage(health_.nextMessage());
    lcm_.publish(options_.channel, message.data(), static_cast<unsigned>(message.size()));
    return message;
  }

  RecordOptions options_;
  HealthMonitor health_{programName(kRecord), ""};
  SplitLog log_;
  Clock::time_point last_sync_ = Clock::now();
  int64_t refused_ = 0;
  int64_t lost_reported_ = 0;
  std::vector<uint8_t> final_message_;
  bool final_message_received_ = false;
  RecordingQueue queue_;
  lcm::LCM lcm_;
};

}  // namespace

bool runRecord(const RecordOptions& options) {
  checkLcmUrl(options.url);
  std::filesystem::create_directories(options.out);
  if (const std::string shortage = shortageOfDisk(options); !shortage.empty()) {
    std::fprintf(stderr, "record: not recording: %s\n", shortage.c_str());
    HealthMonitor health(programName(kRecord), "");
    health.setState(HealthState::kDegraded, "not recording: " + shortage);
    makeLcmBus(options.url)->publish(options.channel, health.nextMessage());
    return false;
  }
  const std::atomic<bool>& stop = stopOnSignals();
  Recorder recorder(options);
  const std::string failure = recorder.run(stop);
  if (failure.empty()) {
    recorder.finish(HealthState::kStopping, "recording ends");
  } else {
    recorder.finish(HealthState::kDegraded, "recording ended: " + failure);
  }
  return failure.empty();
}

}  // namespace redbee
