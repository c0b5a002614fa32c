// A rival in the place of motion segmentation: CAMERA and, for those that want the camera's motion and where
// there is an IMU, INERTIAL_HOMOGRAPHY in; FOREGROUND, DETECTIONS and OVERLAY out. Offline only.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "processes/foreground_publisher.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detection/objects/object_tracker.hpp"
#include "redbee/detection/rivals/rival.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/node/image_queue.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/node/node.hpp"

namespace redbee {

/// Masks are the components of scores from kDecisionScore on, cleaned and followed as the configuration says
/// of ours; segmentation.threshold has no say.
class RivalNode : public Node {
 public:
  /// `rival`: one of rivalNames().
  RivalNode(Bus& bus, const Configuration& configuration, const std::string& rival);
  void process() override;
  void finish() override;
  HealthMonitor& health() override { return health_; }

 private:
  void takeInertial(const inertial_homography_t& message);
  void restart();
  RivalInput inputFor(const image_t& message);
  SegmentationOutput detect(const RivalInput& input);
  void work(const Arrived<image_t>& frame);

  Bus& bus_;
  Configuration configuration_;
  std::string name_;
  HealthMonitor health_;
  RectifiedCamera camera_;
  ForegroundPublisher publisher_;
  std::unique_ptr<Rival> rival_;
  ObjectTracker tracker_;
  ImageQueue images_;
  MessageSynchronizer<inertial_homography_t> inertial_;
  std::optional<int64_t> last_utime_;
};

}  // namespace redbee
