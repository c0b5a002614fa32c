#include "processes/redbee/mosaic/ground_observer.hpp"

#include <utility>

#include "processes/conversions.hpp"
#include "processes/in_process_stack.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/node/message_check.hpp"

namespace redbee {
namespace {

/// Returns whether the log has homographies of its own.
bool readOwn(LogReader& log, const Channels& channels, GroundObserver& observer) {
  bool has_homographies = false;
  const auto take = [&](const LogEvent& event, auto message, auto&& note) {
    if (decodePlausible(event.data, message)) {
      note(message);
    } else {
      observer.onDamaged();
    }
  };
  while (const auto event = log.next()) {
    if (event->channel == channels.fused_homography) {
      take(*event, fused_homography_t(), [&](const auto& m) {
        observer.onFused(m);
        has_homographies = true;
      });
    } else if (event->channel == channels.foreground) {
      take(*event, foreground_t(), [&](const auto& m) { observer.onForeground(m); });
    } else if (event->channel == channels.detections) {
      take(*event, detections_t(), [&](const auto& m) { observer.onDetections(m); });
    }
  }
  return has_homographies;
}

void runStack(LogReader& log, const std::filesystem::path& file, const Configuration& configuration,
              GroundObserver& observer) {
  const Channels& channels = configuration.channels;
  const auto bus = makeLcmBus("memq://");
  const auto fused = bus->subscribe<fused_homography_t>(
      channels.fused_homography, 64, [&](const fused_homography_t& m) { observer.onFused(m); });
  const auto foreground = bus->subscribe<foreground_t>(
      channels.foreground, 64, [&](const foreground_t& m) { observer.onForeground(m); });
  const auto detections = bus->subscribe<detections_t>(
      channels.detections, 64, [&](const detections_t& m) { observer.onDetections(m); });
  InProcessStack stack(*bus, configuration);
  Progress progress("homographies of " + file.filename().string(), "MB");
  while (const auto event = log.next()) {
    if (!isInput(channels, event->channel)) continue;
    bus->publish(event->channel, event->data);
    stack.settle();
    progress.update(log.position() >> 20, log.size() >> 20);
  }
  stack.finish();
  progress.finish();
}

}  // namespace

Exposure exposureAt(const Exposures& exposures, int64_t utime) {
  const auto found = exposures.find(utime);
  return found == exposures.end() ? Exposure() : found->second;
}

void note(const fused_homography_t& fused, Exposures& exposures, GroundChain& chain) {
  exposures[fused.utime] = {rowMotionOf(fused.row_motion), zoomOf(fused)};
  if (fused.source == fused_homography_t::NONE) return;
  chain.addStep(fused.utime_previous, fused.utime, matrix3(fused.step.H));
  for (const int64_t utime : {fused.utime_previous, fused.utime})
    chain.setZoom(utime, exposureAt(exposures, utime).zoom);
  if (fused.has_motion == 0) return;
  const plane_motion_t& m = fused.motion;
  chain.setPlane(fused.utime_previous, {{m.normal[0], m.normal[1], m.normal[2]}, m.distance});
}

void GroundObserver::onFused(const fused_homography_t& fused) { note(fused, exposures_, chain_); }

void GroundObserver::onForeground(const foreground_t& foreground) {
  if (foreground.status == foreground_t::GOOD) masks_[foreground.utime] = foreground.mask;
}

ObservedFrame GroundObserver::frame(int64_t utime) const {
  const auto mask = masks_.find(utime);
  const auto detections = detections_.find(utime);
  return {mask == masks_.end() ? nullptr : &mask->second,
          detections == detections_.end() ? nullptr : &detections->second, exposureAt(exposures_, utime)};
}

GroundObserver observeGround(const std::filesystem::path& file, const Configuration& configuration) {
  LogReader log(file);
  GroundObserver own;
  if (readOwn(log, configuration.channels, own)) return own;
  log.rewind();
  GroundObserver observer;
  runStack(log, file, configuration, observer);
  return observer;
}

}  // namespace redbee
