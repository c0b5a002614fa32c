// Tracks of the moving objects on a map of the ground.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "processes/redbee/mosaic/ground_observer.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/mosaic/mosaic.hpp"

namespace redbee {

struct TrackPoint {
  int64_t utime = 0;         ///< us
  Eigen::Vector2d position;  ///< on the map
};
using GroundTracks = std::map<int32_t, std::vector<TrackPoint>>;  ///< by identity, in order of time

/// Where the middle of a seen box's lower edge meets the ground; std::nullopt for an unseen one, and towards
/// the horizon. `coarsest_area`: of what the mosaic shows (MosaicGrid).
std::optional<Eigen::Vector2d> placeOnMap(const detection_t& detection, const Camera& camera,
                                          const Eigen::Matrix3d& to_map, double coarsest_area);

/// Those of a flight, by placeOnMap(), but for the shortest.
GroundTracks tracksOnMap(const Camera& camera, const GroundObserver& ground, const GroundFrames& frames,
                         double coarsest_area);

/// Whether it is long enough for a path.
bool isDrawn(const std::vector<TrackPoint>& track);

/// What is drawn of a track, on the mosaic's pixels.
struct TrackLine {
  struct Label {
    cv::Point at;
    std::string text;
  };
  int32_t id = 0;
  std::vector<cv::Point> points;
  std::vector<Label> labels;  ///< the ends' last, of which the newest is the last
};
/// With the identity and the time at both ends and the time every two seconds between, in seconds since
/// `start_utime`.
std::vector<TrackLine> linesOf(const GroundTracks& tracks, const MosaicGrid& grid, int64_t start_utime);

/// In the identities' colours.
void drawTracks(cv::Mat3b& image, const std::vector<TrackLine>& lines);

/// utime, id, x, y; one header line.
void writeTracks(const std::filesystem::path& file, const GroundTracks& tracks);

}  // namespace redbee
