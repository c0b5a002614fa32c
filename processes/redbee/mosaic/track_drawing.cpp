#include "processes/redbee/mosaic/track_drawing.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "processes/detection_messages.hpp"
#include "redbee/files/atomic_file.hpp"

namespace redbee {
namespace {

constexpr int64_t kLabelPeriod_us = 2'000'000;
constexpr size_t kShortest = 6;  ///< points; shorter ones are no path

/// Of Okabe and Ito, which the colour-blind can tell, as on the page of redbee serve; BGR.
cv::Scalar trackColour(int32_t id) {
  static const std::array<cv::Scalar, 7> colours = {
      cv::Scalar(0, 159, 230),   cv::Scalar(233, 180, 86), cv::Scalar(150, 200, 0),  cv::Scalar(66, 228, 240),
      cv::Scalar(167, 121, 204), cv::Scalar(61, 122, 255), cv::Scalar(255, 180, 143)};
  return colours[static_cast<size_t>(std::abs(id)) % colours.size()];
}

cv::Point pixelOf(const MosaicGrid& grid, const TrackPoint& point) {
  const Eigen::Vector2d pixel = grid.pixelOf(point.position);
  return {cvRound(pixel.x()), cvRound(pixel.y())};
}

void label(cv::Mat3b& image, const std::string& text, cv::Point at, const cv::Scalar& colour) {
  cv::circle(image, at, 3, cv::Scalar::all(0), cv::FILLED, cv::LINE_AA);
  cv::circle(image, at, 2, colour, cv::FILLED, cv::LINE_AA);
  const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, nullptr);
  const cv::Point corner(std::clamp(at.x + 5, 0, std::max(0, image.cols - size.width)),
                         std::clamp(at.y - 5, size.height, std::max(size.height, image.rows - 2)));
  cv::putText(image, text, corner, cv::FONT_HERSHEY_SIMPLEX, 0.45, cv::Scalar::all(0), 3, cv::LINE_AA);
  cv::putText(image, text, corner, cv::FONT_HERSHEY_SIMPLEX, 0.45, colour, 1, cv::LINE_AA);
}

std::string secondsText(int64_t us) { return fmt::format("{:.1f} s", static_cast<double>(us) / 1e6); }

constexpr double kFurther = 4;  ///< as coarse pixels as the mosaic shows still give a place

}  // namespace

bool isDrawn(const std::vector<TrackPoint>& track) { return track.size() >= kShortest; }

std::optional<Eigen::Vector2d> placeOnMap(const detection_t& detection, const Camera& camera,
                                          const Eigen::Matrix3d& to_map, double coarsest_area) {
  if (detection.seen == 0) return std::nullopt;
  const auto foot = camera.undistort(lowerMiddle(detection));
  const cv::Size image(camera.ideal().width, camera.ideal().height);
  if (!foot || areaOnMap(to_map, *foot, image) >= kFurther * coarsest_area) return std::nullopt;
  return (to_map * foot->homogeneous()).eval().hnormalized();
}

GroundTracks tracksOnMap(const Camera& camera, const GroundObserver& ground, const GroundFrames& frames,
                         double coarsest_area) {
  GroundTracks tracks;
  for (const MappedFrame& frame : frames.frames) {
    const detections_t* detections = ground.frame(frame.utime).detections;
    if (detections == nullptr) continue;
    const Camera lens = zoomed(camera, frame.zoom);
    for (const detection_t& d : detections->detections) {
      if (const auto place = placeOnMap(d, lens, frame.to_map, coarsest_area))
        tracks[d.id].push_back({frame.utime, *place});
    }
  }
  for (auto track = tracks.begin(); track != tracks.end();)
    track = isDrawn(track->second) ? std::next(track) : tracks.erase(track);
  return tracks;
}

std::vector<TrackLine> linesOf(const GroundTracks& tracks, const MosaicGrid& grid, int64_t start_utime) {
  std::vector<TrackLine> lines;
  for (const auto& [id, points] : tracks) {
    if (!isDrawn(points)) continue;
    TrackLine line;
    line.id = id;
    int64_t next = points.front().utime + kLabelPeriod_us;
    for (const TrackPoint& point : points) {
      line.points.push_back(pixelOf(grid, point));
      if (point.utime < next || point.utime > points.back().utime - kLabelPeriod_us / 2) continue;
      line.labels.push_back({line.points.back(), secondsText(point.utime - start_utime)});
      next += kLabelPeriod_us;
    }
    for (const TrackPoint& end : {points.front(), points.back()})
      line.labels.push_back(
          {pixelOf(grid, end), fmt::format("{}: {}", id, secondsText(end.utime - start_utime))});
    lines.push_back(std::move(line));
  }
  return lines;
}

void drawTracks(cv::Mat3b& image, const std::vector<TrackLine>& lines) {
  for (const TrackLine& line : lines) {
    cv::polylines(image, line.points, false, cv::Scalar::all(0), 4, cv::LINE_AA);
    cv::polylines(image, line.points, false, trackColour(line.id), 2, cv::LINE_AA);
  }
  for (const TrackLine& line : lines) {
    for (const auto& [at, text] : line.labels) label(image, text, at, trackColour(line.id));
  }
}

void writeTracks(const std::filesystem::path& file, const GroundTracks& tracks) {
  std::string text = "utime,id,x,y\n";
  for (const auto& [id, points] : tracks) {
    for (const TrackPoint& p : points)
      text += fmt::format("{},{},{:.3f},{:.3f}\n", p.utime, id, p.position.x(), p.position.y());
  }
  writeAtomically(file, text);
}

}  // namespace redbee
