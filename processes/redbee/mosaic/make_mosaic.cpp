#include "processes/redbee/mosaic/make_mosaic.hpp"

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "processes/rectified_camera.hpp"
#include "processes/redbee/mosaic/ground_observer.hpp"
#include "processes/redbee/mosaic/track_drawing.hpp"
#include "processes/warnings.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/json_file.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/image_codec/image_codec.hpp"
#include "redbee/mosaic/mosaic.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/results/png_file.hpp"

namespace redbee {
namespace {

constexpr int kMargin_px = 6;  ///< around masks, whose edges are not sharp

/// On the ideal grid: not 0 where no ground is: movers by the mask and by the boxes, which cover what a mask
/// misses, and what the camera does not show.
cv::Mat1b leftOut(const RectifiedCamera& camera, const GroundObserver& ground, int64_t utime) {
  const CameraIntrinsics& raw_camera = camera.camera().intrinsics();
  cv::Mat1b raw = cv::Mat1b::zeros(raw_camera.height, raw_camera.width);
  if (const auto* png = ground.mask(utime)) {
    const cv::Mat1b mask = decodeGreyImage(*png);
    if (mask.size() == raw.size()) raw = mask.clone();
  }
  if (const detections_t* detections = ground.detections(utime)) {
    for (const detection_t& d : detections->detections)
      cv::rectangle(raw, cv::Rect(d.x, d.y, d.width, d.height), cv::Scalar(255), cv::FILLED);
  }
  cv::Mat1b ideal = camera.rectifier().toIdeal(raw);
  const int side = 2 * kMargin_px + 1;
  cv::dilate(ideal, ideal, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  if (!camera.rectifier().unknown().empty()) ideal |= camera.rectifier().unknown();
  return ideal;
}

/// Without a mask nothing says what moves.
bool isDrawn(const GroundObserver& ground, int64_t utime) { return ground.mask(utime) != nullptr; }

int64_t draw(const MosaicOptions& options, const Configuration& configuration, const GroundObserver& ground,
             const GroundFrames& frames, Mosaic& mosaic) {
  std::map<int64_t, const MappedFrame*> by_time;
  for (const MappedFrame& frame : frames.frames) by_time[frame.utime] = &frame;
  const RectifiedCamera camera(configuration.camera);
  HealthMonitor health("redbee-mosaic", "");
  LogReader log(options.log);
  Progress progress("drawing " + options.log.filename().string(), "MB");
  int64_t drawn = 0;
  int64_t seen = 0;
  while (const auto event = log.next()) {
    if (event->channel != configuration.channels.camera) continue;
    progress.update(log.position() >> 20, log.size() >> 20);
    image_t message;
    if (!decodePlausible(event->data, message)) continue;
    const auto frame = by_time.find(message.utime);
    if (frame == by_time.end() || !isDrawn(ground, message.utime) || seen++ % options.every != 0) continue;
    const IdealImage image = camera.ideal(message, true, health);
    if (image.colour.empty()) continue;
    mosaic.add(image.colour, leftOut(camera, ground, message.utime), frame->second->to_map);
    ++drawn;
  }
  progress.finish();
  printWarning(log.damageReport());
  return drawn;
}

cv::Mat transparent(const cv::Mat3b& image, const cv::Mat1b& known) {
  std::vector<cv::Mat> channels;
  cv::split(image, channels);
  channels.push_back(known);
  cv::Mat result;
  cv::merge(channels, result);
  return result;
}

void writeSummary(const std::filesystem::path& file, const MosaicSummary& s, const MosaicGrid& grid) {
  writeJson(file, {{"frames", s.frames},
                   {"frames_drawn", s.drawn},
                   {"pieces", s.pieces},
                   {"width", s.width},
                   {"height", s.height},
                   {"units_per_px", s.units_per_px},
                   {"unit", s.is_metric ? "m" : "px of the middle frame"},
                   {"origin", {grid.origin.x(), grid.origin.y()}},
                   {"tracks", s.tracks}});
}

}  // namespace

MosaicSummary makeMosaic(const MosaicOptions& options) {
  const Configuration configuration = loadConfiguration(options.configuration);
  const Camera camera(configuration.camera);
  const GroundObserver ground = observeGround(options.log, configuration);
  const GroundFrames frames = mapped(ground.chain().longestPiece(), camera.K_inverse());
  const auto grid = gridFor(frames, {camera.ideal().width, camera.ideal().height}, options.most_px);
  if (!grid)
    throw InputError(options.log, "no homography of the ground leads from one frame to another: no mosaic");
  Mosaic mosaic(*grid);
  MosaicSummary summary;
  summary.drawn = draw(options, configuration, ground, frames, mosaic);
  if (summary.drawn == 0)
    throw InputError(options.log, "no frame on the map has an image and a valid mask: no mosaic");
  summary.frames = static_cast<int64_t>(frames.frames.size());
  summary.pieces = ground.chain().pieces();
  summary.width = grid->size.width;
  summary.height = grid->size.height;
  summary.units_per_px = grid->units_per_px;
  summary.is_metric = frames.is_metric;

  std::filesystem::create_directories(options.out);
  const GroundTracks tracks = tracksOnMap(camera, ground, frames);
  summary.tracks = tracks.size();
  cv::Mat3b image = mosaic.image();
  writePng(options.out / "mosaic.png", transparent(image, mosaic.known()));
  drawTracks(image, tracks, *grid, frames.frames.front().utime);
  writePng(options.out / "tracks.png", image);
  writeTracks(options.out / "tracks.csv", tracks);
  writeSummary(options.out / "summary.json", summary, *grid);
  return summary;
}

}  // namespace redbee
