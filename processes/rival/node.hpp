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
#include "redbee/node/image_stage.hpp"

namespace redbee {

/// Masks are the components of scores from kDecisionScore on, cleaned and followed as the configuration says
/// of ours; segmentation.threshold has no say.
class RivalNode : public ImageStage<inertial_homography_t> {
 public:
  /// `rival`: one of rivalNames().
  RivalNode(Bus& bus, const Configuration& configuration, const std::string& rival);

 private:
  RivalNode(Bus& bus, const Configuration& configuration, const std::string& name,
            std::unique_ptr<Rival> rival);
  RivalInput inputFor(const image_t& message);
  SegmentationOutput detect(const RivalInput& input);
  void work(const image_t& message) override;
  void reset() override { last_utime_.reset(); }

  Configuration configuration_;
  RectifiedCamera camera_;
  ForegroundPublisher foreground_;
  std::unique_ptr<Rival> rival_;
  ObjectTracker tracker_;
  std::optional<int64_t> last_utime_;
};

}  // namespace redbee
