#include "processes/serve/node.hpp"

#include <malloc.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "processes/plausible_subscription.hpp"
#include "redbee/configuration/process_table.hpp"

namespace redbee {
namespace {

constexpr int kQueue = 64;
constexpr std::chrono::milliseconds kBoardPeriod{500};

const char* toneText(Tone tone) {
  switch (tone) {
    case Tone::kGood:
      return "good";
    case Tone::kWarning:
      return "warning";
    case Tone::kBad:
      return "bad";
    case Tone::kPlain:
    case Tone::kHeading:
      break;
  }
  return "plain";
}

}  // namespace

std::string healthText(const HealthBoard& board, HealthBoard::Time now) {
  nlohmann::json processes = nlohmann::json::array();
  for (const HealthBoard::Process& process : board.list(now)) {
    nlohmann::json row{{"name", process.name},
                       {"state", process.state},
                       {"tone", toneText(process.tone)},
                       {"restarts", process.restarts}};
    if (process.last) {
      const process_health_t& h = *process.last;
      row.update({{"pid", h.pid},
                  {"message", h.message},
                  {"rate_in", h.rate_in},
                  {"rate_out", h.rate_out},
                  {"latency_median", h.latency_median},
                  {"latency_p99", h.latency_p99},
                  {"skipped", h.skipped},
                  {"lost", h.lost},
                  {"damaged", h.damaged},
                  {"resident", h.resident},
                  {"calibration", h.calibration},
                  {"silent_s", process.silent_s}});
    }
    processes.push_back(std::move(row));
  }
  return textOf({{"processes", processes}});
}

template <typename Message, typename Handler>
Subscription ServeNode::on(const std::string& channel, Handler handler) {
  return subscribePlausible<Message>(
      bus_, channel, kQueue,
      [this, handler = std::move(handler)](const Message& message) {
        handler(message);
        health_.noteProgress();
      },
      [this] { health_.noteDamaged(); });
}

ServeNode::ServeNode(Bus& bus, const Configuration& configuration, Live& live, LiveMosaic& mosaic)
    : bus_(bus),
      channels_(configuration.channels),
      health_(programName(kServe), configurationHash(configuration)),
      live_(live),
      mosaic_(mosaic),
      assembly_(configuration),
      map_(configuration) {
  always_.push_back(on<detections_t>(channels_.detections, [this](const detections_t& m) {
    health_.noteInput(fromUtime(m.utime));
    health_.noteSequence(channels_.detections, m.sequence);
    map_.onFrame(m.utime, Clock::now());
    assembly_.onDetections(m);
  }));
  always_.push_back(on<pose_t>(channels_.pose, [this](const pose_t& m) { map_.onPose(m); }));
  always_.push_back(on<targets_t>(channels_.targets, [this](const targets_t& m) { map_.onTargets(m); }));
  // The board asks by itself whether it is plausible, and counts.
  always_.push_back(bus_.subscribe<process_health_t>(
      channels_.health, kListenerQueue,
      [this](const process_health_t& m) { board_.onHealth(m, Clock::now()); }));
}

void ServeNode::followViewers() {
  const bool is_watched = live_.viewers() > 0;
  // Who asked last may still be drawing: it is not waited for.
  if (is_watched) to_release_ = false;
  if (to_release_ && mosaic_.release()) {
    to_release_ = false;
    malloc_trim(0);  // what the viewers' threads have freed stays with their arenas otherwise
  }
  if (is_watched == !while_watched_.empty()) return;
  if (is_watched) {
    map_.renew();
    while_watched_.push_back(
        on<fused_homography_t>(channels_.fused_homography, [this](const fused_homography_t& m) {
          map_.onFused(m);
          mosaic_.onFused(m);
          assembly_.onFused(m);
        }));
    while_watched_.push_back(on<image_t>(channels_.camera, [this](const image_t& m) {
      map_.onFrame(m.utime, Clock::now());
      assembly_.onImage(m);
    }));
    while_watched_.push_back(
        on<foreground_t>(channels_.foreground, [this](const foreground_t& m) { assembly_.onForeground(m); }));
  } else {
    while_watched_.clear();
    assembly_.dropImages();
    live_.forget();
    to_release_ = true;
  }
}

void ServeNode::publishHealth() {
  const auto now = Clock::now();
  if (live_.viewers() == 0 || now < next_board_) return;
  next_board_ = now + kBoardPeriod;
  live_.setHealth(healthText(board_, now));
}

void ServeNode::publishMap() {
  if (live_.viewers() == 0) return;
  if (auto text = map_.takeText(Clock::now())) live_.setMap(std::move(*text));
}

bool ServeNode::processNext() {
  followViewers();
  if (auto view = assembly_.takeFrame()) {
    health_.notePublished(fromUtime(view->utime));
    mosaic_.onFrame(*view, Clock::now());
    live_.setFrame(std::move(*view));
  }
  publishHealth();
  publishMap();
  if (health_.state() == HealthState::kStarting) health_.setState(HealthState::kGood);
  return false;
}

}  // namespace redbee
