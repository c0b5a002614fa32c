#include "processes/geolocation/node.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "processes/geolocation/target_messages.hpp"
#include "processes/geolocation/view_fault_words.hpp"
#include "processes/lens_messages.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/geometry/angle.hpp"

namespace redbee {
namespace {

constexpr size_t kMaxPendingDetections = 64;
constexpr Duration kPoseWait = std::chrono::milliseconds(100);
constexpr Duration kLensMemory = std::chrono::seconds(1);       // detections come in order of time
constexpr Duration kBoxFaultMemory = std::chrono::seconds(10);  // some boxes fit into any image
// Boxes that end beyond the image are of another camera, or of a stray or forged message. Each counts as much
// as so many messages with boxes that fit, and five within a short time say that it is another camera.
constexpr int kBoxFaultWeight = 8;
constexpr int kOtherCameraScore = 5 * kBoxFaultWeight;
constexpr double kFocalTolerance = 0.05;  // of a lens that is the configured one

const Configuration& enabled(const Configuration& configuration) {
  if (configuration.geolocation.enabled) return configuration;
  throw UserError("geolocation.enabled: is false in this configuration; set it to true");
}

}  // namespace

GeolocationNode::GeolocationNode(Bus& bus, const Configuration& configuration)
    : GeolocationNode(bus, configuration, configurationHash(configuration)) {}

GeolocationNode::GeolocationNode(Bus& bus, const Configuration& configuration, const std::string& hash)
    : Stage(bus, programName(kGeolocation), hash),
      configuration_(enabled(configuration)),
      timeshift_(fromSeconds(configuration.inertial.extrinsics.timeshift_s)),
      views_(configuration.geolocation, configuration.inertial.extrinsics.R_CI,
             configuration.inertial.extrinsics.p_IC),
      geolocator_(configuration.camera, configuration.geolocation) {
  if (configuration_.inertial.lens.enabled) lens_.emplace(configuration_.inertial.lens, timeshift_);
  const auto& channels = configuration_.channels;
  on<detections_t>(channels.detections, [this](const detections_t& m) { onDetections(m); });
  on<pose_t>(channels.pose, [this](const pose_t& m) {
    const VehiclePose pose = vehiclePoseOf(m);
    clock_.noteOther(pose.time);
    views_.note(pose);
  });
  on<gimbal_t>(channels.gimbal, [this](const gimbal_t& m) { views_.note(mountAttitudeOf(m)); });
  on<lens_t>(channels.lens, [this](const lens_t& m) { onLens(m); });
  if (configuration_.has_altimeter) {
    on<altimeter_t>(channels.altimeter, [this](const altimeter_t& m) { views_.note(heightOf(m)); });
  }
}

void GeolocationNode::onDetections(const detections_t& message) {
  std::string fault = boxFault(message);
  if (countStray(message, fault)) return health().noteDamaged();
  queueFrame(pending_, configuration_.channels.detections, CameraTime(fromUtime(message.utime)),
             Frame{message, std::move(fault), WorkTimer()});
  health().noteSkipped(static_cast<int64_t>(pending_.limitTo(kMaxPendingDetections).size()));
  if (const auto newest = pending_.newest()) clock_.noteFrame(*newest);
}

bool GeolocationNode::countStray(const detections_t& message, const std::string& box_fault) {
  if (message.detections.empty()) return false;  // fits any camera
  const bool fits = box_fault.empty();
  box_fault_score_ = std::clamp(box_fault_score_ + (fits ? -1 : kBoxFaultWeight), 0, kOtherCameraScore);
  return !fits && box_fault_score_ < kOtherCameraScore;
}

void GeolocationNode::onLens(const lens_t& message) {
  if (lens_) {
    if (const auto sample = lensSampleOf(message, configuration_)) lens_->add(*sample);
    return;
  }
  if (message.has_focal_length == 0) return;
  const CameraIntrinsics& camera = configuration_.camera;
  const double focal_px = message.focal_length * camera.width / message.width;
  const bool fits = std::abs(focal_px - camera.fx) <= kFocalTolerance * camera.fx;
  lens_fault_ = fits
                    ? ""
                    : fmt::format("{} says a focal length of {:.0f} px, configured are {:.0f} px (camera.fx)",
                                  configuration_.channels.lens, focal_px, camera.fx);
}

void GeolocationNode::restart(CameraTime) {
  geolocator_.restart();
  clock_.restart();
  box_fault_.clear();
  box_fault_score_ = 0;
}

bool GeolocationNode::isReadyFor(CameraTime time) const {
  const bool has_lens = !lens_ || lens_->reaches(imuTimeOf(time));
  return isFinishing() || (views_.hasPoseAt(imuTimeOf(time)) && has_lens) || now() >= time + kPoseWait;
}

bool GeolocationNode::processNext() {
  if (pending_.empty() || !isInOrder(pending_) || !isReadyFor(pending_.frontTime())) return false;
  const CameraTime time = pending_.frontTime();
  const Frame frame = pending_.pop();
  workOn(time, frame.arrival, [&] { locate(time, frame.message, frame.box_fault); });
  return true;
}

std::string GeolocationNode::boxFault(const detections_t& detections) const {
  const CameraIntrinsics& camera = configuration_.camera;
  for (const detection_t& d : detections.detections) {
    if (d.x >= 0 && d.y >= 0 && d.x + d.width <= camera.width && d.y + d.height <= camera.height) continue;
    return fmt::format("{} are of another camera: a box ends at {},{} px, configured is an image of {}x{}",
                       configuration_.channels.detections, d.x + d.width, d.y + d.height, camera.width,
                       camera.height);
  }
  return "";
}

std::string GeolocationNode::cameraFault(CameraTime time, const std::string& box_fault) {
  if (!lens_fault_.empty()) return lens_fault_;
  if (!box_fault.empty()) {
    box_fault_ = box_fault;
    box_fault_time_ = time;
    geolocator_.restart();  // who fitted into the image by chance is elsewhere
  }
  const bool lasts = time - box_fault_time_ < kBoxFaultMemory;
  return lasts ? box_fault_ : "";
}

void GeolocationNode::locate(CameraTime time, const detections_t& detections, const std::string& box_fault) {
  const std::string camera_fault = cameraFault(time, box_fault);
  const ViewEstimate estimate = views_.at(imuTimeOf(time));
  const Zoom zoom = lens_ ? lens_->at(imuTimeOf(time)) : Zoom();
  if (lens_) lens_->eraseBefore(imuTimeOf(time) - kLensMemory);
  geolocator_.setZoom(zoom.value, zoom.variance);
  if (views_.frame().takeRestart()) geolocator_.restart();
  stopped_.restore(toUtime(time), views_.frame(), geolocator_);
  // A frame without a trusted mask shows nothing, not even that nobody moves.
  const bool is_blind = !camera_fault.empty() || detections.status != foreground_t::GOOD;
  const std::vector<Target> targets =
      geolocator_.step(time, is_blind ? std::nullopt : estimate.view, boxesOf(detections));
  stopped_.keep(toUtime(time), views_.frame(), geolocator_);
  noteResultReady();
  targets_t message{};
  message.status =
      camera_fault.empty() ? static_cast<int8_t>(estimate.fault) : int8_t{targets_t::OTHER_CAMERA};
  message.has_global = views_.frame().isGlobal() ? 1 : 0;
  fillView(message, estimate);
  if (estimate.view) {
    const auto footprint = footprintOf(geolocator_.intrinsics(), geolocator_.camera(), *estimate.view,
                                       configuration_.geolocation.min_depression_deg * kDegree);
    if (footprint) fillFootprint(message, *footprint);
  }
  message.refused_horizon = geolocator_.refused().above_horizon;
  message.refused_border = geolocator_.refused().cut_off;
  message.targets.reserve(targets.size());
  for (const Target& target : targets) message.targets.push_back(messageOf(target, views_.frame()));
  message.n = static_cast<int32_t>(message.targets.size());
  describe(message.status, estimate, camera_fault, zoom.is_known);
  if (!isPlausible(message)) {
    // Covariances that no estimator has, or a camera that is off its orbit: nothing follows from them.
    geolocator_.restart();
    message = {};
    message.status = targets_t::NO_POSITION;
    health().setState(HealthState::kDegraded, "from " + configuration_.channels.pose +
                                                  " no plausible place follows: targets are forgotten");
  }
  publish(configuration_.channels.targets, message);
}

std::string GeolocationNode::faultText(const ViewEstimate& estimate) const {
  std::string words = wordsOf(estimate.fault, configuration_.channels);
  if (estimate.fault == ViewFault::kNoPose)
    return words + " has come: redbee-autopilot publishes it, where autopilot.link is set";
  if (estimate.fault == ViewFault::kStalePose) {
    return words + fmt::format(": the nearest is {:.2f} s from the frame, allowed are {:.2f} s",
                               estimate.age_s, configuration_.geolocation.max_pose_age_s);
  }
  return words;
}

void GeolocationNode::describe(int8_t status, const ViewEstimate& estimate, const std::string& camera_fault,
                               bool is_lens_known) {
  if (status == targets_t::GOOD && !is_lens_known) {
    return health().setState(
        HealthState::kDegraded,
        "no " + configuration_.channels.lens + " near the frame (lens.enabled): its focal length is a guess");
  }
  if (status == targets_t::GOOD) {
    const RefusedBoxes refused = geolocator_.refused();
    return health().setState(
        HealthState::kGood,
        refused.above_horizon == 0
            ? ""
            : fmt::format("{} boxes less than {:.0f} deg below the horizon are not placed",
                          refused.above_horizon, configuration_.geolocation.min_depression_deg));
  }
  health().setState(HealthState::kDegraded, camera_fault.empty() ? faultText(estimate) : camera_fault);
}

}  // namespace redbee
