// CAMERA in and, for detectors that need the camera's motion, FUSED_HOMOGRAPHY, or VISUAL_HOMOGRAPHY while no
// fused homography is available; FOREGROUND, DETECTIONS and OVERLAY out. Runs any detector.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "processes/foreground_publisher.hpp"
#include "processes/motion_segmentation/homography_path.hpp"
#include "processes/motion_segmentation/track_id_store.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detection/adjustable_quality.hpp"
#include "redbee/detection/detector.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/node/image_stage.hpp"
#include "redbee/node/quality_ladder.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee {

/// Publishes one message of each kind per frame. Maps and boxes are on the raw image's grid.
class MotionSegmentationNode : public ImageStage<fused_homography_t> {
 public:
  MotionSegmentationNode(Bus& bus, const Configuration& configuration);
  /// With a detector that was made of the same configuration.
  MotionSegmentationNode(Bus& bus, const Configuration& configuration, std::unique_ptr<Detector> detector);
  void keepStateIn(const std::filesystem::path& folder) override {
    identities_ = TrackIdStore(folder / "identities");
  }

 private:
  void work(const image_t& message) override;
  /// Whether vision has skipped the frame: one that both skip costs less than two.
  bool isLeftOut(CameraTime frame) const override;
  /// Vision's homography is waited for as well where the fused ones say nothing about the frame; and where
  /// vision's does not either, what connects a later frame to the last processed one.
  bool isWaiting(CameraTime frame) override;
  FrameInput inputFor(const image_t& message);
  /// While the fusion is not running or has no estimate yet after a restart, vision's own homography
  /// preserves background and identities. False if there is none.
  bool addVisual(FrameInput& input) const;
  /// What all homographies that have arrived say.
  std::vector<HomographyLink> allLinks() const;
  /// Whether the motion from the last processed frame to one after this is known: vision has not seen this
  /// one, but background and tracks go on with the next.
  bool isBridged(CameraTime frame) const;
  /// Whether it may become known: vision still tracks from a frame before this one.
  bool isBridgePending(CameraTime frame);
  /// The homography from the last processed frame, by the fused homographies alone: asked for again and again
  /// while a frame waits, computed once for what has arrived.
  std::optional<Eigen::Matrix3d> fusedPathTo(CameraTime frame);
  /// As the messages about the frame say it.
  Exposure exposureOf(CameraTime frame) const;
  /// Leaves the images empty if the message cannot be decoded to the camera's size. Returns what was taken
  /// out.
  Exposure decodeInto(FrameInput& input, const image_t& message);
  void publishOutput(const image_t& message, const FrameInput& input, DetectorOutput output,
                     const Exposure& exposure);
  /// While this stage is slower than the camera it leaves out elements of the detection before frames.
  void adjustQuality(CameraTime frame);
  void updateState(DetectorStatus status, bool has_fused);
  void reset(CameraTime newest) override;

  Configuration configuration_;
  std::unique_ptr<Detector> detector_;
  AdjustableQuality* adjustable_;  ///< the detector; nullptr if it knows one quality only
  QualityLadder ladder_;
  DetectorNeeds needs_;
  RectifiedCamera camera_;
  ForegroundPublisher foreground_;
  MessageSynchronizer<visual_homography_t> visual_;
  struct FusedPath {
    CameraTime to;
    std::optional<Eigen::Matrix3d> H;
  };
  std::optional<FusedPath> fused_path_;  ///< until another fused homography arrives
  std::optional<CameraTime> unbridged_;  ///< the frame known to be, until another homography arrives
  std::optional<CameraTime> last_;       ///< the last processed frame
  double zoom_ = 1;                      ///< of that frame
  TrackIdStore identities_;
};

}  // namespace redbee
