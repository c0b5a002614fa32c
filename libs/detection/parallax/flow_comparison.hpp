// The flow of an image, compared with the parallax segment: row by row, as maps of all that is computed of a
// row would be most of the stage's memory.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "redbee/detection/parallax/flow_covariance.hpp"
#include "redbee/detection/parallax/parallax_segment.hpp"
#include "redbee/detection/parallax/photometric_gain.hpp"
#include "redbee/detection/parallax/registration_error.hpp"

namespace redbee {

/// How static surfaces seem to move.
struct StaticMotion {
  ParallaxSegment segment;
  HomographyFlow error;     ///< of the registration
  bool is_direction_known;  ///< of the parallax
};

class FlowComparison {
 public:
  /// `earlier`: aligned to `current`; `flow`: px, from there to it; `noise`: its covariance. The images are
  /// not copied.
  FlowComparison(const cv::Mat1b& current, const cv::Mat1b& earlier, const cv::Mat2f& flow,
                 const FlowCovariance& noise, const StaticMotion& motion)
      : current_(current), earlier_(earlier), flow_(flow), noise_(noise), motion_(motion) {}

  /// Where a row's values are written to: see ResidualRow.
  struct Row {
    cv::Vec2f* normalized_residual;
    cv::Vec2f* nearest;
    float* squared;
    cv::Vec2f* speed;
  };
  void compareRow(int y, const uint8_t* unknown, const Row& to);

  /// Valid as long as this.
  ImagePair images(const cv::Mat1b& unknown);
  const cv::Mat2f& flow() const { return flow_; }
  bool isDirectionKnown() const { return motion_.is_direction_known; }

 private:
  cv::Mat1b current_, earlier_;
  cv::Mat2f flow_;
  FlowCovariance noise_;
  StaticMotion motion_;
};

}  // namespace redbee
