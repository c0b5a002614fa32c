#include "processes/redbee/mosaic/ground_ties.hpp"

#include <Eigen/Geometry>
#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cmath>
#include <utility>

#include "processes/geolocation/target_messages.hpp"
#include "processes/geolocation/view_fault_words.hpp"
#include "redbee/geolocation/ground_point.hpp"
#include "redbee/geometry/angle.hpp"
#include "redbee/node/message_check.hpp"

namespace redbee {
namespace {

using GeographicLib::UTMUPS;

constexpr int kSamples = 3;  ///< points along each side of a frame

double sigmaOf(const GroundPoint& point, const GroundView& view) {
  const Eigen::Matrix2d covariance =
      point.J_attitude * view.attitude_covariance * point.J_attitude.transpose() + view.position_covariance +
      point.J_height * view.height_sigma_m * view.height_sigma_m * point.J_height.transpose();
  constexpr double kLeast_m = 0.01;  // no autopilot knows its place better
  return std::max(kLeast_m, std::sqrt(0.5 * covariance.trace()));
}

}  // namespace

GroundTieFinder::GroundTieFinder(const Configuration& configuration, const Camera& camera,
                                 const GroundFrames& frames, const MosaicGrid& grid)
    : configuration_(configuration),
      ideal_(camera.ideal()),
      frames_(frames.frames),
      grid_(grid),
      views_(configuration.geolocation, configuration.inertial.extrinsics.R_CI,
             configuration.inertial.extrinsics.p_IC) {}

void GroundTieFinder::note(const LogEvent& event) {
  const Channels& channels = configuration_.channels;
  if (event.channel == channels.pose) {
    if (pose_t m; decodePlausible(event.data, m)) views_.note(vehiclePoseOf(m));
  } else if (event.channel == channels.gimbal) {
    if (gimbal_t m; decodePlausible(event.data, m)) views_.note(mountAttitudeOf(m));
  } else if (event.channel == channels.altimeter && configuration_.has_altimeter) {
    if (altimeter_t m; decodePlausible(event.data, m)) views_.note(heightOf(m));
  }
  while (next_ < frames_.size() && views_.hasPoseAt(timeOf(frames_[next_]))) add(frames_[next_++]);
}

GroundTies GroundTieFinder::result() {
  while (next_ < frames_.size()) add(frames_[next_++]);
  if (found_.ties.empty()) found_.why_empty = whyEmpty();
  if (zone_) found_.epsg = UTMUPS::EncodeEPSG(zone_->number, zone_->is_north);
  return std::move(found_);
}

void GroundTieFinder::add(const MappedFrame& frame) {
  const ViewEstimate estimate = views_.at(timeOf(frame));
  if (views_.frame().takeRestart()) found_.ties.clear();
  fault_ = estimate.fault;
  if (!estimate.view || !views_.frame().isGlobal()) return;
  const cv::Size image(ideal_.width, ideal_.height);
  const auto model = makeCameraModel(zoomed(ideal_, frame.zoom));
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const int column = i % kSamples, row = i / kSamples;
    const Eigen::Vector2d pixel((0.5 + column) * image.width / kSamples - 0.5,
                                (0.5 + row) * image.height / kSamples - 0.5);
    if (areaOnMap(frame.to_map, pixel, image) > grid_.coarsest_area) continue;
    const auto point =
        groundPointOf(*model, pixel, *estimate.view, configuration_.geolocation.min_depression_deg * kDegree);
    if (!point) continue;
    if (const auto place = onGrid(point->position))
      found_.ties.push_back({(frame.to_map * pixel.homogeneous()).eval().hnormalized(), *place,
                             sigmaOf(*point, *estimate.view)});
  }
}

ImuTime GroundTieFinder::timeOf(const MappedFrame& frame) const {
  return toImu(CameraTime(fromUtime(frame.utime)),
               fromSeconds(configuration_.inertial.extrinsics.timeshift_s));
}

/// The first place's zone is that of all; std::nullopt so far off that the zone does not reach there.
std::optional<Eigen::Vector2d> GroundTieFinder::onGrid(const Eigen::Vector2d& position) {
  const Geodetic place = views_.frame().geodeticOf(position);
  Zone zone;
  Eigen::Vector2d on_grid;
  try {
    UTMUPS::Forward(place.latitude_deg, place.longitude_deg, zone.number, zone.is_north, on_grid.x(),
                    on_grid.y(), zone_ ? zone_->number : int{UTMUPS::STANDARD});
  } catch (const GeographicLib::GeographicErr&) {
    return std::nullopt;
  }
  if (!zone_) zone_ = zone;
  if (zone.is_north != zone_->is_north && zone_->number != UTMUPS::UPS)
    on_grid.y() += zone_->is_north ? -UTMUPS::UTMShift() : UTMUPS::UTMShift();
  return on_grid;
}

std::string GroundTieFinder::whyEmpty() const {
  const Channels& channels = configuration_.channels;
  if (fault_ != ViewFault::kNone) return wordsOf(fault_, channels);
  return views_.frame().isGlobal() ? "by " + channels.pose + " the camera does not see the ground"
                                   : channels.pose + " has no latitude and longitude";
}

}  // namespace redbee
