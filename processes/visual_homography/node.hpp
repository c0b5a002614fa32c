// CAMERA and INERTIAL_HOMOGRAPHY in; VISUAL_HOMOGRAPHY out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "redbee/configuration/configuration.hpp"
#include "redbee/image_t.hpp"
#include "redbee/imaging/rectifier.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/node/image_queue.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/node/node.hpp"
#include "redbee/visual/visual_homography.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee {

/// One message per frame. The inertial homography of the frame is waited for while its publisher is alive.
class VisualHomographyNode : public Node {
 public:
  VisualHomographyNode(Bus& bus, const Configuration& configuration);
  void process() override;
  void finish() override;
  HealthMonitor& health() override { return health_; }

 private:
  void takeInertial(const inertial_homography_t& message);
  /// The inertial messages from the frame that is tracked from up to this one, composed; nothing where one is
  /// missing.
  std::optional<HomographyPrediction> prediction(int64_t utime) const;
  void track(const Arrived<image_t>& frame);
  void publish(const VisualHomography& result);
  void restart();

  Bus& bus_;
  Configuration configuration_;
  HealthMonitor health_;
  Camera camera_;
  Rectifier rectifier_;
  std::unique_ptr<VisualHomographyEstimator> estimator_;
  ImageQueue images_;
  MessageSynchronizer<inertial_homography_t> inertial_;
  int32_t sequence_ = 0;
};

}  // namespace redbee
