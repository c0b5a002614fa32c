#include "redbee/simulation/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/rolling_shutter.hpp"
#include "redbee/simulation/camera_rays.hpp"
#include "redbee/simulation/scene_view.hpp"

namespace redbee::simulation {
namespace {

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
    const RowViews rows = viewsOfRows(pose_at, t_s);
    image.surface = nearestSurfaces(scene_, camera_, rays_, rows);
    labelMovers(image, t_s);
    const cv::Mat light = shade(rows, image.surface);
    image.grey = expose(light, t_s, index);
    if (sensor_.colour) image.bgr = expose(coloured(light, image.surface), t_s, index);
    return image;
  }

 private:
  RowViews viewsOfRows(const PoseAt& pose_at, double t_s) const {
    const CameraIntrinsics& camera = camera_.intrinsics();
    const int rows = camera.line_delay_s == 0 ? 1 : camera.height;
    std::vector<SceneView> views;
    for (int row = 0; row < rows; ++row) {
      const double at_s = t_s + (rows == 1 ? 0 : rowTime(camera, row));
      views.push_back(simulation::viewOf(scene_, pose_at(at_s), at_s));
    }
    return RowViews(std::move(views));
  }

  void addSurface(const Material& material) {
    const auto same = std::find(materials_.begin(), materials_.end(), material);
    textures_.push_back(same == materials_.end() ? std::make_shared<const Texture>(material)
                                                 : textures_[static_cast<size_t>(same - materials_.begin())]);
    materials_.push_back(material);
    tints_.push_back(tintOf(material.bgr));
  }

  void labelMovers(RenderedImage& image, double t_s) const {
    cv::Mat_<uchar> mask_of(1, 256, uchar{0}), id_of(1, 256, uchar{0});
    uchar movers = 0;
    std::map<int, uchar> numbers;  // of objects of several parts
    for (size_t i = 0; i < scene_.patches.size(); ++i) {
      const Patch& patch = scene_.patches[i];
      if (patch.kind != PatchKind::kMover) continue;
      mask_of(static_cast<int>(i) + 1) = patch.motion.isMovingAt(t_s) ? kMaskMoving : kMaskStopped;
      const auto known = patch.object == 0 ? numbers.end() : numbers.find(patch.object);
      const uchar number = known == numbers.end() ? ++movers : known->second;
      if (patch.object != 0) numbers[patch.object] = number;
      id_of(static_cast<int>(i) + 1) = number;
    }
    cv::LUT(image.surface, mask_of, image.mask);
    cv::LUT(image.surface, id_of, image.id);
  }

  cv::Mat shade(const RowViews& rows, const cv::Mat_<uchar>& surface) const {
    cv::Mat_<float> light(surface.size());
    for (int y = 0; y < surface.rows; ++y) {
      const SceneView& view = rows.at(y);
      for (int x = 0; x < surface.cols; ++x) {
        const size_t i = surface(y, x);
        light(y, x) = i == kSurfaceSky
                          ? static_cast<float>(scene_.sky_grey)
                          : shadePixel(view.planes[i], view.waves[i], *textures_[i], rays_(y, x));
      }
    }
    const cv::Mat1b shadows = groundShadows(scene_, camera_, rays_, rows, surface);
    if (!shadows.empty()) cv::Mat(light * scene_.shadow_gain).copyTo(light, shadows);
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
  cv::Mat_<cv::Vec2f> rays_;  ///< x / z and y / z of every raw pixel, in C
  /// Ground first, then the patches; surfaces of one material share a texture.
  std::vector<std::shared_ptr<const Texture>> textures_;
  std::vector<Material> materials_;  ///< as textures_
  std::vector<cv::Vec3f> tints_;     ///< as textures_
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
