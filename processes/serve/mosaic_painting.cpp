#include "processes/serve/mosaic_painting.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "redbee/image_codec/jpeg.hpp"

namespace redbee {
namespace {

constexpr int64_t kPointPeriod_us = 100'000;  ///< of a track
constexpr int kQuality = 85;
constexpr int kMostRefused = 20;  ///< five seconds

nlohmann::json jsonOf(const TrackLine& line) {
  std::vector<cv::Point> corners;
  cv::approxPolyDP(line.points, corners, 1, false);
  nlohmann::json points = nlohmann::json::array();
  for (const cv::Point& point : corners) points.push_back({point.x, point.y});
  nlohmann::json labels = nlohmann::json::array();
  for (const auto& [at, text] : line.labels) labels.push_back({at.x, at.y, text});
  return {{"id", line.id}, {"points", points}, {"labels", labels}};
}

}  // namespace

bool MosaicPainting::begin(const MosaicFrame& frame) {
  const auto grid =
      gridFor({{{frame.utime, frame.to_map, frame.exposure.zoom}}, frame.is_metric, frame.to_map},
              painter_.idealSize(), kMost_px);
  if (!grid) return false;
  why_ = has_lost_flight_ ? "the flight was too far from what it showed" : frame.why;
  has_lost_flight_ = false;
  mosaic_.emplace(*grid);
  tracks_.clear();
  number_ = frame.mosaic;
  map_ = frame.map;
  is_metric_ = frame.is_metric;
  start_utime_ = frame.utime;
  is_relaid_ = false;
  frames_ = refused_ = 0;
  return true;
}

bool MosaicPainting::makeRoomFor(const MosaicFrame& frame) {
  if (!mosaic_ || frame.mosaic != number_) return begin(frame);
  if (!mosaic_->makeRoomFor(frame.to_map, painter_.idealSize(), kMost_px)) {
    if (++refused_ < kMostRefused) return false;
    mosaic_.reset();  // the next begins where the flight is
    has_lost_flight_ = true;
    return false;
  }
  refused_ = 0;
  if (mosaic_->isCut()) cutTracks();
  return true;
}

void MosaicPainting::add(const MosaicFrame& frame) {
  if (frame.image) paint(frame);
  addTracks(frame);
}

void MosaicPainting::clear() {
  mosaic_.reset();
  tracks_.clear();
  bundle_.reset();
  has_lost_flight_ = false;
  refused_ = 0;
}

std::shared_ptr<const std::string> MosaicPainting::newest(int64_t after) {
  if (!mosaic_ || sequence_ == after) return nullptr;
  if (!bundle_) bundle_ = std::make_shared<const std::string>(encode());
  return bundle_;
}

void MosaicPainting::paint(const MosaicFrame& frame) {
  if (!makeRoomFor(frame)) return;
  if (frame.map != map_) mosaic_->fade();
  is_relaid_ = is_relaid_ || frame.map != map_;
  map_ = frame.map;
  const ObservedFrame observed{&frame.mask, &frame.detections, frame.exposure};
  if (!painter_.paint(*frame.image, observed, frame.to_map, *mosaic_)) return;
  utime_ = frame.utime;
  ++frames_;
  ++sequence_;
  bundle_.reset();
}

void MosaicPainting::cutTracks() {
  const MosaicGrid& grid = mosaic_->grid();
  const auto isOutside = [&](const TrackPoint& point) {
    const Eigen::Vector2d pixel = grid.pixelOf(point.position);
    return !cv::Rect2d({0, 0}, cv::Size2d(grid.size)).contains({pixel.x(), pixel.y()});
  };
  for (auto track = tracks_.begin(); track != tracks_.end();) {
    std::vector<TrackPoint>& points = track->second;
    points.erase(std::remove_if(points.begin(), points.end(), isOutside), points.end());
    track = points.empty() ? tracks_.erase(track) : std::next(track);
  }
}

void MosaicPainting::addTracks(const MosaicFrame& frame) {
  // A map that a frame's image did not fit on has no place for what was seen in it.
  if (!mosaic_ || frame.mosaic != number_ || refused_ > 0) return;
  const Camera lens = zoomed(painter_.camera(), frame.exposure.zoom);
  for (const detection_t& d : frame.detections.detections) {
    const auto place = placeOnMap(d, lens, frame.to_map, mosaic_->grid().coarsest_area);
    if (!place) continue;
    std::vector<TrackPoint>& track = tracks_[d.id];
    if (!track.empty() && frame.utime < track.back().utime + kPointPeriod_us) continue;
    track.push_back({frame.utime, *place});
    if (track.size() <= kMostPoints) continue;
    size_t kept = 0;
    for (size_t i = 0; i < track.size(); i += 2) track[kept++] = track[i];
    track.resize(kept);
  }
  const auto isOlder = [](const auto& a, const auto& b) {
    return a.second.back().utime < b.second.back().utime;
  };
  while (tracks_.size() > kMostTracks)
    tracks_.erase(std::min_element(tracks_.begin(), tracks_.end(), isOlder));
}

std::string MosaicPainting::encode() const {
  const std::vector<uint8_t> jpeg = encodeJpeg(mosaic_->image(), kQuality);
  nlohmann::json tracks = nlohmann::json::array();
  for (const TrackLine& line : linesOf(tracks_, mosaic_->grid(), start_utime_))
    tracks.push_back(jsonOf(line));
  std::vector<std::string> notes;
  if (*why_ != 0) notes.push_back(std::string("begun anew: ") + why_);
  if (is_relaid_) notes.emplace_back("laid anew where the flight was: it did not fit the ground's plane");
  if (mosaic_->isCut()) notes.emplace_back("the ground furthest from the flight has left it");
  return bundleOf({{"sequence", sequence_},
                   {"width", mosaic_->grid().size.width},
                   {"height", mosaic_->grid().size.height},
                   {"image_bytes", jpeg.size()},
                   {"mask_bytes", 0},
                   {"utime", utime_},
                   {"start", start_utime_},
                   {"units_per_px", mosaic_->grid().units_per_px},
                   {"unit", is_metric_ ? "m" : "px"},
                   {"frames", frames_},
                   {"tracks", tracks},
                   {"notes", notes}},
                  jpeg, {});
}

}  // namespace redbee
