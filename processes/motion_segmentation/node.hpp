// CAMERA and FUSED_HOMOGRAPHY in, VISUAL_HOMOGRAPHY for when the fusion is away; FOREGROUND, DETECTIONS and
// OVERLAY out.
#pragma once

#include <cstdint>
#include <optional>

#include "processes/foreground_publisher.hpp"
#include "processes/motion_segmentation/track_id_store.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detection/motion_segmenter.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/node/image_queue.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/node/node.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee {

/// One message of each kind per frame. Maps and boxes are on the raw image's grid.
class MotionSegmentationNode : public Node {
 public:
  MotionSegmentationNode(Bus& bus, const Configuration& configuration);
  void process() override;
  void finish() override;
  HealthMonitor& health() override { return health_; }
  void keepStateIn(const std::filesystem::path& folder) override {
    identities_ = TrackIdStore(folder / "identities");
  }

 private:
  /// The last frame that was segmented, and where it lay in its epoch.
  struct Last {
    int64_t utime;
    int32_t epoch;
    int64_t utime_anchor;
    Eigen::Matrix3d H_anchor;
  };

  void segment(const Arrived<image_t>& frame);
  SegmentationInput inputFor(const image_t& message) const;
  void addVisual(SegmentationInput& input) const;
  /// Black where there is no image of the camera's size.
  void decodeInto(SegmentationInput& input, const image_t& message);
  void publish(const image_t& message, const SegmentationInput& input, SegmentationOutput output);
  void restart();

  Bus& bus_;
  Configuration configuration_;
  HealthMonitor health_;
  RectifiedCamera camera_;
  ForegroundPublisher publisher_;
  MotionSegmenter segmenter_;
  ImageQueue images_;
  MessageSynchronizer<fused_homography_t> fused_;
  MessageSynchronizer<visual_homography_t> visual_;
  std::optional<Last> last_;
  TrackIdStore identities_;
};

}  // namespace redbee
