#include "processes/redbee/evaluate/overlay_video.hpp"

#include <cstdio>
#include <memory>

#include "redbee/bus/image.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/configuration/configuration_files.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/results/overlay.hpp"
#include "redbee/results/png_file.hpp"
#include "redbee/results/run_folder.hpp"
#include "redbee/results/video_writer.hpp"

namespace redbee {
namespace {

std::vector<Detection> at(const DetectionsByTime& detections, int64_t utime) {
  std::vector<Detection> found;
  const auto [begin, end] = detections.equal_range(utime);
  for (auto it = begin; it != end; ++it) found.push_back(it->second);
  return found;
}

}  // namespace

void forEachOverlay(const std::filesystem::path& log_file, const std::filesystem::path& configuration_file,
                    const std::filesystem::path& results,
                    const std::function<void(int64_t utime, const cv::Mat& drawn)>& draw) {
  const Configuration configuration = loadConfiguration(configuration_file);
  const RunFolder run(results);
  const DetectionsByTime detections = run.detections();
  LogReader log(log_file);
  Progress progress("drawing " + log_file.filename().string(), "MB");
  while (const auto event = log.next()) {
    if (event->channel != configuration.channels.camera) continue;
    progress.update(log.position() >> 20, log.size() >> 20);
    image_t message;
    if (!decodePlausible(event->data, message)) continue;
    const auto image = decodeColour(message);
    if (!image || !run.has(RunMap::kMask, message.utime)) continue;
    const cv::Mat1b mask = run.readOrZeros(RunMap::kMask, message.utime, image->size());
    OverlayStatus status;
    status.time = CameraTime(fromUtime(message.utime));
    draw(message.utime, drawOverlay(*image, mask, at(detections, message.utime), status));
  }
}

void renderOverlay(const OverlayOptions& options) {
  requireNoInput(options.video, options.configuration, {options.log});
  constexpr double kDefaultFps = 24;
  std::unique_ptr<VideoWriter> writer;
  cv::Mat first;
  int64_t first_utime = 0;
  int64_t count = 0;
  if (!options.stills.empty()) std::filesystem::create_directories(options.stills);
  const auto take = [&](int64_t utime, const cv::Mat& drawn) {
    const cv::Mat even = drawn(cv::Rect(0, 0, drawn.cols & ~1, drawn.rows & ~1));
    if (!options.stills.empty() && count % OverlayOptions::kStillPeriod == 0) {
      writePng(options.stills / (nameOfFrame(utime) + ".png"), drawn);
    }
    if (count++ == 0) {
      first = even.clone();
      first_utime = utime;
      return;
    }
    if (!writer) {  // the second frame gives the encoder a frame rate; each is shown at its own time
      const double fps = 1e6 / static_cast<double>(utime - first_utime);
      writer = std::make_unique<VideoWriter>(options.video, even.size(),
                                             fps > 0 && fps < 1000 ? fps : kDefaultFps);
      writer->write(first, 0);
    }
    writer->write(even, seconds(fromUtime(utime - first_utime)));
  };
  forEachOverlay(options.log, options.configuration, options.results, take);
  if (!writer) throw InputError(options.results, "has masks of fewer than two frames of the flight");
  writer->close();
  std::printf("%s: %lld frames\n", options.video.c_str(), static_cast<long long>(count));
}

}  // namespace redbee
