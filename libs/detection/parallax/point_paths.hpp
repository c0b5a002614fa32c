// Points of strong texture, followed for a second: whether their paths are those of static surfaces at one
// depth. What is too small or too slow for the dense flow of one baseline has a path that no static point
// has. libs/README.md, (67) and (68).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/detection/objects/static_path.hpp"
#include "redbee/detection/parallax/registration_error.hpp"
#include "redbee/detection/parallax/textured_pixels.hpp"
#include "redbee/detection/parameters.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/imaging/pyramid.hpp"
#include "redbee/visual/patch_alignment.hpp"

namespace redbee {

/// A point that is followed from image to image. Pixels are those of the images.
struct PointPath {
  static constexpr size_t kMostSamples = 12;

  Eigen::Vector2d at = Eigen::Vector2d::Zero();        ///< px
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< px per frame: over the ground, smoothed
  std::array<Eigen::Vector2d, kMostSamples>
      samples;         ///< px: where it was at the sampled frames, newest first
  size_t sampled = 0;  ///< number of `samples` that count
  /// Of the fits to the samples: roots of the mean squared normalized residuals, and the log likelihood ratio
  /// of a moving point against a static one. 0 until it has been followed for long enough.
  double static_residual = 0, moving_residual = 0, log_likelihood = 0;

  bool isTested() const { return static_residual > 0; }
};

class PointPaths {
 public:
  explicit PointPaths(const ParallaxParameters& parameters);

  void reset();
  /// To the next image; more than once where one was not processed. `ground`: homography, previous to current
  /// [px]; `motion`: over the same step. Without it all paths begin anew.
  void propagate(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion);
  /// `K`: camera matrix [px]. `excluded`: not 0 where no point is followed; may be empty.
  void update(CameraTime time, const cv::Mat1b& grey, const Eigen::Matrix3d& K,
              const cv::Mat1b& excluded = {});
  /// Those of the last image.
  const std::vector<PointPath>& paths() const { return paths_; }

 private:
  struct Sample {
    int64_t frame;         ///< CameraPath::current() of then
    HomographyFlow error;  ///< of its registration to the current frame
  };
  using Template = PatchTemplate<NativeLanes>;

  void follow(const Pyramid& image, const Eigen::Matrix3d& ground, const cv::Mat1b& excluded);
  bool advance(PointPath& path, const Pyramid& image, const Eigen::Matrix3d& ground);
  void registerSamples();
  void findTexture(const cv::Mat1b& grey);
  void test(PointPath& path, const Symmetric2f& tensor);
  void begin(const cv::Mat1b& excluded);
  void sample();
  /// Of a point's earlier position in the current image, the registration's error removed.
  CameraPath::Sighting sighting(const Sample& sample, const Eigen::Vector2d& at) const;
  bool isInside(const Eigen::Vector2d& p) const;

  double scale_;  ///< full-size pixels per pixel of the images
  double direction_error_;
  PatchShape shape_;
  Template forward_, backward_;
  CameraPath camera_;
  Pyramid previous_;
  cv::Size size_;
  std::deque<Sample> samples_;  ///< newest first
  double since_sample_s_ = 0;
  std::optional<CameraTime> last_time_;
  std::optional<Eigen::Matrix3d> ground_;  ///< since the last image
  std::optional<PlaneMotion> motion_;      ///< since then
  Eigen::Matrix3d K_;                      ///< of that image [px]
  std::vector<PointPath> paths_;
  std::vector<cv::Point> pixels_;  ///< where they are
  TexturedPixels texture_;
};

}  // namespace redbee
