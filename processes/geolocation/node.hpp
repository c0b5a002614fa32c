// DETECTIONS, POSE, GIMBAL, ALTIMETER and LENS in; TARGETS out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "processes/geolocation/stopped_store.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/geolocation/geolocator.hpp"
#include "redbee/geolocation/view_estimator.hpp"
#include "redbee/inertial/lens_track.hpp"
#include "redbee/lens_t.hpp"
#include "redbee/node/message_clock.hpp"
#include "redbee/node/stage.hpp"
#include "redbee/targets_t.hpp"

namespace redbee {

/// Answers each DETECTIONS in order of time, as soon as a pose of that time has come, or after a tenth of a
/// second of message time without one.
class GeolocationNode : public Stage {
 public:
  /// Throws UserError unless geolocation.enabled is set.
  GeolocationNode(Bus& bus, const Configuration& configuration);
  /// `hash`: configurationHash(), which costs more than a second of messages, for who makes many nodes.
  GeolocationNode(Bus& bus, const Configuration& configuration, const std::string& hash);
  bool processNext() override;
  /// Who has stopped is known after a restart.
  void keepStateIn(const std::filesystem::path& folder) override {
    stopped_ = StoppedStore(folder / "stopped_targets");
  }

 private:
  struct Frame {
    detections_t message;
    std::string box_fault;
    WorkTimer arrival;
  };
  void onDetections(const detections_t& message);
  void onLens(const lens_t& message);
  ImuTime imuTimeOf(CameraTime time) const { return toImu(time, timeshift_); }
  bool isReadyFor(CameraTime time) const;
  void locate(CameraTime time, const detections_t& detections, const std::string& box_fault);
  /// Boxes beyond the image, but too seldom for another camera.
  bool countStray(const detections_t& message, const std::string& box_fault);
  /// What shows that the boxes are of another camera than the configured one; empty: nothing does.
  std::string boxFault(const detections_t& detections) const;
  /// The same, or what has shown it lately; targets that were placed before are forgotten.
  std::string cameraFault(CameraTime time, const std::string& box_fault);
  void describe(int8_t status, const ViewEstimate& estimate, const std::string& camera_fault,
                bool is_lens_known);
  std::string faultText(const ViewEstimate& estimate) const;
  void restart(CameraTime newest) override;
  CameraTime now() const override { return clock_.now(); }

  Configuration configuration_;
  Duration timeshift_;
  ViewEstimator views_;
  Geolocator geolocator_;
  StoppedStore stopped_;
  FrameQueue<Frame> pending_;
  MessageClock clock_;
  std::string lens_fault_;
  std::string box_fault_;
  CameraTime box_fault_time_;
  int box_fault_score_ = 0;
  std::optional<LensTrack> lens_;  ///< of one that zooms
};

}  // namespace redbee
