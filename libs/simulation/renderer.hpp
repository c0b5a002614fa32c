// Renders images of a scene, with one ray through each raw pixel's centre.
#pragma once

#include <functional>
#include <memory>
#include <opencv2/core.hpp>

#include "redbee/geometry/camera.hpp"
#include "redbee/simulation/camera_pose.hpp"
#include "redbee/simulation/scene.hpp"

namespace redbee::simulation {

struct SensorParameters {
  double noise_sigma = 1.5;      ///< grey levels, white
  double exposure_drift = 0;     ///< relative amplitude of a slow sinusoid of the gain
  double exposure_period_s = 5;  ///< s
  double blur_sigma_px = 0;      ///< Gaussian, px
  bool colour = false;           ///< also render BGR
  unsigned seed = 1;             ///< of the noise
};

inline constexpr uchar kMaskMoving = 255;
inline constexpr uchar kMaskStopped = 170;
inline constexpr uchar kSurfaceGround = 0;
inline constexpr uchar kSurfaceSky = 255;

struct RenderedImage {
  cv::Mat1b grey;
  cv::Mat3b bgr;      ///< empty unless requested
  cv::Mat1b mask;     ///< 0 background, kMaskMoving, kMaskStopped
  cv::Mat1b id;       ///< 0 background, 1..N the mover, in the order of the scene's movers
  cv::Mat1b surface;  ///< kSurfaceGround, kSurfaceSky, or 1 + index of the patch in the scene
};

class Renderer {
 public:
  /// Throws std::invalid_argument for more than 254 patches, and if a pixel's ray does not point forward.
  Renderer(const Camera& camera, const Scene& scene, const SensorParameters& sensor);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Pose of the camera at a time of the trajectory [s].
  using PoseAt = std::function<CameraPose(double t_s)>;
  /// Renders the scene at t_s, with a rolling shutter each row at its own time (camera_intrinsics.hpp),
  /// labels alike. The same arguments give the same image; `index` seeds the noise; `zoom`: focal length over
  /// the camera's.
  RenderedImage render(const PoseAt& pose_at, double t_s, unsigned index, double zoom = 1) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace redbee::simulation
