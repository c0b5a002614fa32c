#include "processes/redbee/detect/collector.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "processes/conversions.hpp"
#include "processes/detection_messages.hpp"
#include "processes/health_check.hpp"
#include "processes/plausible_subscription.hpp"
#include "redbee/bus/build_version.hpp"
#include "redbee/files/input_error.hpp"

namespace redbee {
namespace {

std::string_view bytesOf(const std::vector<uint8_t>& data) {
  return {reinterpret_cast<const char*>(data.data()), data.size()};
}

nlohmann::json stageJson(const process_health_t& health) {
  return {{"median_ms", health.work_median}, {"p99_ms", health.work_p99}, {"mean_ms", health.work_mean},
          {"frames", health.published},      {"skipped", health.skipped}, {"lost", health.lost},
          {"damaged", health.damaged},       {"timed_out", health.late},  {"resident_bytes", health.resident},
          {"state", health.state},           {"message", health.message}};
}

/// Per frame of the run [ms]; the figures of each stage are added to `stages`.
nlohmann::json cpuJson(const ProcessUsage& usage, int64_t frames, nlohmann::json& stages) {
  const auto per_frame = [&](double milliseconds) { return milliseconds / static_cast<double>(frames); };
  CpuTime sum;
  for (const auto& [stage, time] : usage.stages) {
    sum.work += time.work;
    sum.publishing += time.publishing;
    stages[stage]["cpu_ms_per_frame"] = per_frame(time.work);
    stages[stage]["cpu_publishing_ms_per_frame"] = per_frame(time.publishing);
  }
  return {{"work", per_frame(sum.work)},
          {"publishing", per_frame(sum.publishing)},
          {"process", per_frame(1000 * usage.cpu_s)}};
}

}  // namespace

ResultCollector::ResultCollector(Bus& bus, const Channels& channels, std::filesystem::path folder)
    : run_(std::move(folder)) {
  run_.prepare();
  const auto damaged = [this] { ++damaged_; };
  subscriptions_.push_back(subscribePlausible<foreground_t>(
      bus, channels.foreground, kListenerQueue, [this](const foreground_t& m) { onForeground(m); }, damaged));
  subscriptions_.push_back(subscribePlausible<detections_t>(
      bus, channels.detections, kListenerQueue, [this](const detections_t& m) { detections_[m.utime] = m; },
      damaged));
  subscriptions_.push_back(subscribePlausible<fused_homography_t>(
      bus, channels.fused_homography, kListenerQueue, [this](const fused_homography_t& m) { onFused(m); },
      damaged));
  subscriptions_.push_back(subscribePlausible<process_health_t>(
      bus, channels.health, kListenerQueue,
      [this](const process_health_t& m) {
        if (isKnownProcess(m.process)) health_[m.process] = m;
      },
      damaged));
}

int64_t ResultCollector::framesWithImage() const {
  return std::count_if(status_.begin(), status_.end(),
                       [](const auto& frame) { return frame.second != foreground_t::BAD_IMAGE; });
}

int64_t ResultCollector::trustedFrames() const {
  return std::count_if(status_.begin(), status_.end(),
                       [](const auto& frame) { return frame.second == foreground_t::GOOD; });
}

void ResultCollector::onForeground(const foreground_t& message) {
  foreground_sequence_.note(message.sequence);
  status_[message.utime] = message.status;
  try {
    run_.write(RunMap::kProbability, message.utime, bytesOf(message.probability));
    run_.write(RunMap::kMask, message.utime, bytesOf(message.mask));
  } catch (const InputError& error) {
    if (first_failure_.empty()) first_failure_ = error.what();
  }
}

void ResultCollector::onFused(const fused_homography_t& message) {
  fused_sequence_.note(message.sequence);
  fused_homography_t& kept = homographies_[message.utime] = message;
  kept.tracks = {};
}

void ResultCollector::writeDetections() const {
  DetectionsCsv csv = run_.createDetections();
  int64_t frame = 0;
  for (const auto& [utime, status] : status_) {
    const auto found = detections_.find(utime);
    if (found != detections_.end()) {
      for (const detection_t& detection : found->second.detections)
        csv.write(frame, utime, detectionOf(detection));
    }
    ++frame;
  }
  csv.close();
}

void ResultCollector::writeHomographies() const {
  HomographyCsv csv = run_.createHomographies();
  for (const auto& [utime, fused] : homographies_) {
    FrameHomographies row;
    row.epoch = fused.epoch;
    if (fused.source != fused_homography_t::NONE) row.ground = matrix3(fused.step.H);
    if (fused.has_front != 0 && fused.utime_tracks == fused.utime_previous)
      row.front = matrix3(fused.H_front);
    row.source = toString(static_cast<FusionSource>(fused.source));
    csv.write(utime, row);
  }
  csv.close();
}

void ResultCollector::writeTables(double wall_s, const std::optional<ProcessUsage>& usage) const {
  if (!first_failure_.empty()) throw InputError(first_failure_);
  writeDetections();
  writeHomographies();
  nlohmann::json stages;
  double slowest_ms = 0;
  int64_t lost = foreground_sequence_.lost() + fused_sequence_.lost() + damaged_;
  int64_t skipped = 0;
  int64_t timed_out = 0;
  int64_t resident = 0;
  for (const auto& [process, health] : health_) {
    stages[process] = stageJson(health);
    slowest_ms = std::max(slowest_ms, health.work_mean);
    lost += health.lost + health.damaged;
    skipped += health.skipped;
    timed_out += health.late;
    resident += health.resident;
  }
  const nlohmann::json cpu =
      usage && frames() > 0 ? cpuJson(*usage, frames(), stages) : nlohmann::json::object();
  const auto per_second = [](double milliseconds) { return milliseconds > 0 ? 1000 / milliseconds : 0; };
  run_.writeSummary(
      {{"version", buildVersion()},
       {"frames", frames()},
       {"frames_good", trustedFrames()},
       {"fps", per_second(slowest_ms)},  // frames over wall time of the slowest stage, decoding included
       {"wall_s", wall_s},
       {"lost", lost},
       {"skipped", skipped},
       {"timed_out", timed_out},
       {"stages", stages},
       {"cpu_ms_per_frame", cpu.value("work", nlohmann::json())},  // decoding and algorithm, all stages
       {"cpu_publishing_ms_per_frame", cpu.value("publishing", nlohmann::json())},
       {"cpu_process_ms_per_frame", cpu.value("process", nlohmann::json())},  // log and results included
       {"peak_rss_bytes", usage ? usage->peak_resident_bytes : resident}});
}

}  // namespace redbee
