// CAMERA and INERTIAL_HOMOGRAPHY in; VISUAL_HOMOGRAPHY out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "redbee/configuration/configuration.hpp"
#include "redbee/image_t.hpp"
#include "redbee/imaging/rectifier.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/node/image_stage.hpp"
#include "redbee/visual/visual_homography.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee {

/// One message per frame. The inertial homography of the frame is waited for while its publisher is alive.
class VisualHomographyNode : public ImageStage<inertial_homography_t> {
 public:
  VisualHomographyNode(Bus& bus, const Configuration& configuration);

 private:
  /// The inertial messages from the frame that is tracked from up to this one, composed; std::nullopt if one
  /// is missing.
  std::optional<HomographyPrediction> prediction(CameraTime time) const;
  void work(const image_t& message) override;
  void refuse(const image_t& image);
  void publishResult(const VisualHomography& result);
  void reset() override;

  Configuration configuration_;
  Camera camera_;
  Rectifier rectifier_;
  std::unique_ptr<VisualHomographyEstimator> estimator_;
};

}  // namespace redbee
