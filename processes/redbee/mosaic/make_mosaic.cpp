#include "processes/redbee/mosaic/make_mosaic.hpp"

#include <spdlog/fmt/fmt.h>

#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "processes/redbee/mosaic/frame_painter.hpp"
#include "processes/redbee/mosaic/geotiff_file.hpp"
#include "processes/redbee/mosaic/ground_observer.hpp"
#include "processes/redbee/mosaic/ground_ties.hpp"
#include "processes/redbee/mosaic/track_drawing.hpp"
#include "processes/warnings.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/json_file.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/mosaic/mosaic.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/results/png_file.hpp"

namespace redbee {
namespace {

int64_t draw(const MosaicOptions& options, const Configuration& configuration, GroundObserver& ground,
             const GroundFrames& frames, Mosaic& mosaic, GroundTieFinder& ties) {
  std::map<int64_t, const MappedFrame*> by_time;
  for (const MappedFrame& frame : frames.frames) by_time[frame.utime] = &frame;
  FramePainter painter(configuration.camera, configuration.own_parts);
  LogReader log(options.log);
  Progress progress("drawing " + options.log.filename().string(), "MB");
  int64_t drawn = 0;
  int64_t seen = 0;
  while (const auto event = log.next()) {
    ties.note(*event);
    if (event->channel != configuration.channels.camera) continue;
    progress.update(log.position() >> 20, log.size() >> 20);
    image_t message;
    if (!decodePlausible(event->data, message)) {
      ground.onDamaged();
      continue;
    }
    const auto frame = by_time.find(message.utime);
    if (frame == by_time.end()) continue;
    const ObservedFrame observed = ground.frame(message.utime);
    if (observed.mask == nullptr || seen++ % options.every != 0) continue;
    if (painter.paint(message, observed, frame->second->to_map, mosaic)) ++drawn;
  }
  progress.finish();
  printWarning(log.damageReport());
  return drawn;
}

cv::Mat4b transparent(const cv::Mat3b& image, const cv::Mat1b& known) {
  std::vector<cv::Mat> channels;
  cv::split(image, channels);
  channels.push_back(known);
  cv::Mat4b result;
  cv::merge(channels, result);
  return result;
}

/// Returns the place on the earth as summary.json says it; without one, why.
nlohmann::json writeOnEarth(const std::filesystem::path& file, const GroundTies& ties, const MosaicGrid& grid,
                            const cv::Mat4b& image, MosaicSummary& summary) {
  std::filesystem::remove(file);  // of an earlier run
  const auto reference = georeference(ties.ties);
  if (!reference) {
    summary.why_no_place = ties.why_empty.empty() ? "all poses are of one place" : ties.why_empty;
    return nullptr;
  }
  writeGeoTiff(file, image, grid, *reference, ties.epsg);
  summary.epsg = ties.epsg;
  summary.residual_m = reference->residual_m;
  return {{"epsg", ties.epsg}, {"m_per_unit", reference->scale}, {"residual_m", reference->residual_m}};
}

void writeSummary(const std::filesystem::path& file, const MosaicSummary& s, const MosaicGrid& grid,
                  const nlohmann::json& on_earth) {
  writeJson(file, {{"frames", s.frames},
                   {"frames_drawn", s.drawn},
                   {"pieces", s.pieces},
                   {"width", s.width},
                   {"height", s.height},
                   {"units_per_px", s.units_per_px},
                   {"unit", s.is_metric ? "m" : "px of the middle frame"},
                   {"origin", {grid.origin.x(), grid.origin.y()}},
                   {"on_earth", on_earth},
                   {"tracks", s.tracks}});
}

}  // namespace

MosaicSummary makeMosaic(const MosaicOptions& options) {
  const Configuration configuration = loadConfiguration(options.configuration);
  const Camera camera(configuration.camera);
  checkWritableFolder(options.out);  // before the work of minutes
  GroundObserver ground = observeGround(options.log, configuration);
  const GroundFrames frames = mapped(ground.chain().longestPiece(), camera.K());
  const auto grid = gridFor(frames, {camera.ideal().width, camera.ideal().height}, options.most_px);
  if (!grid)
    throw InputError(options.log, "no homography of the ground leads from one frame to another: no mosaic");
  Mosaic mosaic(*grid);
  MosaicSummary summary;
  GroundTieFinder ties(configuration, camera, frames, *grid);
  summary.drawn = draw(options, configuration, ground, frames, mosaic, ties);
  if (summary.drawn == 0)
    throw InputError(options.log, "no frame on the map has an image and a valid mask: no mosaic");
  summary.frames = static_cast<int64_t>(frames.frames.size());
  summary.pieces = ground.chain().pieces();
  summary.width = grid->size.width;
  summary.height = grid->size.height;
  summary.units_per_px = grid->units_per_px;
  summary.is_metric = frames.is_metric;

  std::filesystem::create_directories(options.out);
  const GroundTracks tracks = tracksOnMap(camera, ground, frames, grid->coarsest_area);
  summary.tracks = tracks.size();
  cv::Mat3b image = mosaic.image();
  const cv::Mat4b transparent_image = transparent(image, mosaic.known());
  writePng(options.out / "mosaic.png", transparent_image);
  const nlohmann::json on_earth =
      writeOnEarth(options.out / "mosaic.tif", ties.result(), *grid, transparent_image, summary);
  drawTracks(image, linesOf(tracks, *grid, frames.frames.front().utime));
  writePng(options.out / "tracks.png", image);
  writeTracks(options.out / "tracks.csv", tracks);
  writeSummary(options.out / "summary.json", summary, *grid, on_earth);
  if (ground.damaged() > 0) {
    printWarning(fmt::format("{}: {} damaged or implausible messages are left out", options.log.string(),
                             ground.damaged()));
  }
  return summary;
}

}  // namespace redbee
