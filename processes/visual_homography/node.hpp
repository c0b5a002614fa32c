// CAMERA and INERTIAL_HOMOGRAPHY in; VISUAL_HOMOGRAPHY out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "redbee/configuration/configuration.hpp"
#include "redbee/earlier_step_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/imaging/image_row_motion.hpp"
#include "redbee/imaging/rectifier.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/node/image_stage.hpp"
#include "redbee/visual/visual_homography.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee {

/// Publishes one message per frame, with the inertial homography of the frame as prediction unless it timed
/// out.
class VisualHomographyNode : public ImageStage<inertial_homography_t> {
 public:
  VisualHomographyNode(Bus& bus, const Configuration& configuration);

 private:
  /// The composed inertial homographies from the reference frame to this one; std::nullopt if one is missing.
  std::optional<HomographyPrediction> prediction(CameraTime time) const;
  void work(const image_t& message) override;
  /// So that nobody waits for the homography.
  void noteLeftOut(CameraTime frame) override;
  void noteMissing(CameraTime frame) override;
  cv::Mat1b rectified(const cv::Mat1b& raw, CameraTime time);
  void followLens(CameraTime time);
  void publishNone(CameraTime frame, int8_t status);
  void publishResult(const VisualHomography& result);
  void reset(CameraTime newest) override;

  Configuration configuration_;
  Camera camera_;
  Rectifier rectifier_;
  ImageRowMotion row_motion_;
  std::unique_ptr<VisualHomographyEstimator> estimator_;
  double zoom_ = 1;           ///< of the last image
  earlier_step_t earlier_{};  ///< of the message before
};

}  // namespace redbee
