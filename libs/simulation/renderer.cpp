#include "redbee/simulation/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/rolling_shutter.hpp"
#include "redbee/simulation/camera_rays.hpp"
#include "redbee/simulation/plane_view.hpp"
#include "redbee/simulation/wave_field.hpp"

namespace redbee::simulation {
namespace {

constexpr float kHorizonInverseDepth = 1e-3F;  // 1/m: ground farther away than this is sky

/// Scaled so that the grey level of the coloured surface is the uncoloured one.
cv::Vec3f tintOf(const Eigen::Vector3d& bgr) {
  const Eigen::Vector3d scaled = bgr / bgr.dot(Eigen::Vector3d(0.114, 0.587, 0.299));
  return {static_cast<float>(scaled[0]), static_cast<float>(scaled[1]), static_cast<float>(scaled[2])};
}

}  // namespace

class Renderer::Implementation {
 public:
  Implementation(const Camera& camera, Scene scene, const SensorParameters& sensor)
      : camera_(camera), scene_(std::move(scene)), sensor_(sensor), rays_(raysOf(camera)) {
    if (scene_.patches.size() > 254) throw std::invalid_argument("a scene has at most 254 patches");
    addSurface(scene_.ground);
    for (const Patch& patch : scene_.patches) addSurface(patch.material);
  }

  /// The same scene through a lens of another focal length.
  Implementation zoomedTo(double zoom) const {
    Implementation other = *this;
    other.camera_ = zoomed(camera_, zoom);
    other.rays_ = raysOf(other.camera_);
    return other;
  }

  RenderedImage render(const PoseAt& pose_at, double t_s, unsigned index) const {
    RenderedImage image;
    const std::vector<SceneView> rows = viewsOfRows(pose_at, t_s);
    image.surface = nearestSurfaces(rows);
    labelMovers(image, t_s);
    const cv::Mat light = shade(rows, image.surface);
    image.grey = expose(light, t_s, index);
    if (sensor_.colour) image.bgr = expose(coloured(light, image.surface), t_s, index);
    return image;
  }

 private:
  /// The scene at the time of one row, or of all of them.
  struct SceneView {
    double t_s;
    CameraPose pose;
    std::vector<PlaneView> planes;  ///< the ground's first, then the patches'
    std::vector<std::optional<WaveField>> waves;
  };

  std::vector<SceneView> viewsOfRows(const PoseAt& pose_at, double t_s) const {
    const CameraIntrinsics& camera = camera_.intrinsics();
    const int rows = camera.line_delay_s == 0 ? 1 : camera.height;
    std::vector<SceneView> views;
    for (int row = 0; row < rows; ++row) {
      const double at_s = t_s + (rows == 1 ? 0 : rowTime(camera, row));
      const CameraPose pose = pose_at(at_s);
      views.push_back({at_s, pose, planeViews(pose, at_s), wavesAt(at_s)});
    }
    return views;
  }

  static const SceneView& viewOf(const std::vector<SceneView>& rows, int row) {
    return rows.size() == 1 ? rows.front() : rows[static_cast<size_t>(row)];
  }

  std::vector<std::optional<WaveField>> wavesAt(double t_s) const {
    std::vector<std::optional<WaveField>> waves(scene_.patches.size() + 1);
    for (size_t i = 0; i < scene_.patches.size(); ++i) {
      if (scene_.patches[i].waving) waves[i + 1].emplace(*scene_.patches[i].waving, t_s);
    }
    return waves;
  }

  void addSurface(const Material& material) {
    textures_.emplace_back(material);
    tints_.push_back(tintOf(material.bgr));
  }

  std::vector<PlaneView> planeViews(const CameraPose& pose, double t_s) const {
    std::vector<PlaneView> views{simulation::viewOf(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(),
                                                    Eigen::Vector3d::UnitY(), pose)};
    for (const Patch& patch : scene_.patches) {
      views.push_back(simulation::viewOf(centreAt(patch, t_s), patch.axis_u, patch.axis_v, pose));
    }
    return views;
  }

  cv::Mat nearestSurfaces(const std::vector<SceneView>& rows) const {
    cv::Mat_<uchar> surface(rays_.size());
    cv::Mat_<float> inverse_depth(rays_.size());
    layGround(rows, surface, inverse_depth);
    for (size_t i = 0; i < scene_.patches.size(); ++i) layPatch(i, rows, surface, inverse_depth);
    return surface;
  }

  void layGround(const std::vector<SceneView>& rows, cv::Mat_<uchar>& surface,
                 cv::Mat_<float>& inverse_depth) const {
    for (int y = 0; y < rays_.rows; ++y) {
      const PlaneView& view = viewOf(rows, y).planes.front();
      for (int x = 0; x < rays_.cols; ++x) {
        const cv::Vec2f& ray = rays_(y, x);
        const float q = view.Q.x() * ray[0] + view.Q.y() * ray[1] + view.Q.z();
        surface(y, x) = q > kHorizonInverseDepth ? kSurfaceGround : kSurfaceSky;
        inverse_depth(y, x) = std::max(q, kHorizonInverseDepth);
      }
    }
  }

  /// Box of a patch in the image: the whole image with a rolling shutter.
  cv::Rect boxIn(const Patch& patch, const std::vector<SceneView>& rows) const {
    if (rows.size() > 1) return {0, 0, rays_.cols, rays_.rows};
    return boxOf(patch, rows.front().pose, rows.front().t_s, camera_);
  }

  void layPatch(size_t index, const std::vector<SceneView>& rows, cv::Mat_<uchar>& surface,
                cv::Mat_<float>& inverse_depth) const {
    const Patch& patch = scene_.patches[index];
    const cv::Rect box = boxIn(patch, rows);
    const auto half_width = static_cast<float>(patch.width_m / 2),
               half_height = static_cast<float>(patch.height_m / 2);
    for (int y = box.y; y < box.br().y; ++y) {
      const PlaneView& view = viewOf(rows, y).planes[index + 1];
      for (int x = box.x; x < box.br().x; ++x) {
        const Eigen::Vector3f ray(rays_(y, x)[0], rays_(y, x)[1], 1);
        const float q = view.Q.dot(ray);
        if (q <= inverse_depth(y, x)) continue;
        if (!insideShape(patch.shape, view.U.dot(ray) / (q * half_width),
                         view.V.dot(ray) / (q * half_height)))
          continue;
        surface(y, x) = static_cast<uchar>(index + 1);
        inverse_depth(y, x) = q;
      }
    }
  }

  void labelMovers(RenderedImage& image, double t_s) const {
    cv::Mat_<uchar> mask_of(1, 256, uchar{0}), id_of(1, 256, uchar{0});
    uchar movers = 0;
    for (size_t i = 0; i < scene_.patches.size(); ++i) {
      const Patch& patch = scene_.patches[i];
      if (patch.kind != PatchKind::kMover) continue;
      mask_of(static_cast<int>(i) + 1) = patch.motion.isMovingAt(t_s) ? kMaskMoving : kMaskStopped;
      id_of(static_cast<int>(i) + 1) = ++movers;
    }
    cv::LUT(image.surface, mask_of, image.mask);
    cv::LUT(image.surface, id_of, image.id);
  }

  cv::Mat shade(const std::vector<SceneView>& rows, const cv::Mat_<uchar>& surface) const {
    cv::Mat_<float> light(surface.size());
    for (int y = 0; y < surface.rows; ++y) {
      const SceneView& view = viewOf(rows, y);
      for (int x = 0; x < surface.cols; ++x) {
        const size_t i = surface(y, x);
        light(y, x) = i == kSurfaceSky ? static_cast<float>(scene_.sky_grey)
                                       : shadePixel(view.planes[i], view.waves[i], textures_[i], rays_(y, x));
      }
    }
    return light;
  }

  float shadePixel(const PlaneView& view, const std::optional<WaveField>& wave, const Texture& texture,
                   const cv::Vec2f& direction) const {
    const Eigen::Vector3f ray(direction[0], direction[1], 1);
    const float depth = 1 / view.Q.dot(ray);
    float u = view.U.dot(ray) * depth, v = view.V.dot(ray) * depth;
    // Derivatives by the ray's slopes, times the slope of one pixel.
    const auto pixel_x = static_cast<float>(depth / camera_.intrinsics().fx);
    const auto pixel_y = static_cast<float>(depth / camera_.intrinsics().fy);
    const Footprint footprint{
        (view.U.x() - u * view.Q.x()) * pixel_x, (view.V.x() - v * view.Q.x()) * pixel_x,
        (view.U.y() - u * view.Q.y()) * pixel_y, (view.V.y() - v * view.Q.y()) * pixel_y};
    if (wave) {
      const Eigen::Vector2f shift = wave->shiftAt(u, v);
      u += shift.x();
      v += shift.y();
    }
    return texture.sample(u, v, footprint);
  }

  cv::Mat coloured(const cv::Mat_<float>& light, const cv::Mat_<uchar>& surface) const {
    const cv::Vec3f sky = tintOf({1.15, 1.0, 0.92});
    cv::Mat_<cv::Vec3f> bgr(light.size());
    for (int y = 0; y < light.rows; ++y) {
      for (int x = 0; x < light.cols; ++x) {
        bgr(y, x) = light(y, x) * (surface(y, x) == kSurfaceSky ? sky : tints_[surface(y, x)]);
      }
    }
    return bgr;
  }

  /// Lens blur, gain and noise.
  cv::Mat expose(const cv::Mat& light, double t_s, unsigned index) const {
    cv::Mat exposed = light;
    if (sensor_.blur_sigma_px > 0) cv::GaussianBlur(light, exposed, {}, sensor_.blur_sigma_px);
    const double gain = 1 + sensor_.exposure_drift * std::sin(kTurn * t_s / sensor_.exposure_period_s);
    cv::Mat noise(light.size(), light.type(), cv::Scalar::all(0));
    if (sensor_.noise_sigma > 0) {
      cv::RNG random((static_cast<std::uint64_t>(sensor_.seed) << 32U) + index * 0x9E3779B9ULL + 1);
      random.fill(noise, cv::RNG::NORMAL, 0, sensor_.noise_sigma);
    }
    cv::Mat image;
    cv::scaleAdd(exposed, gain, noise, noise);
    noise.convertTo(image, CV_8U);
    return image;
  }

  Camera camera_;
  Scene scene_;
  SensorParameters sensor_;
  cv::Mat_<cv::Vec2f> rays_;       ///< x / z and y / z of every raw pixel, in C
  std::vector<Texture> textures_;  ///< ground first, then the patches
  std::vector<cv::Vec3f> tints_;   ///< as textures_
};

Renderer::Renderer(const Camera& camera, const Scene& scene, const SensorParameters& sensor)
    : implementation_(std::make_unique<Implementation>(camera, scene, sensor)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

RenderedImage Renderer::render(const PoseAt& pose_at, double t_s, unsigned index, double zoom) const {
  if (zoom != 1) return implementation_->zoomedTo(zoom).render(pose_at, t_s, index);
  return implementation_->render(pose_at, t_s, index);
}

}  // namespace redbee::simulation
