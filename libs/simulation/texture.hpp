// Procedural surfaces: periodic, band-limited grey maps with a mip chain, sampled in metres.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee::simulation {

enum class TextureKind {
  kGrass,   ///< fine grain of many scales
  kFacade,  ///< brick courses and windows, some 4 m apart
  kWater,   ///< broad, soft patches
  kBody,    ///< bold patches of two tones, as on clothes and cars
};

struct Material {
  TextureKind kind = TextureKind::kGrass;
  unsigned seed = 1;
  double texel_m = 0.015;        ///< m; the map repeats after 1024 texels
  double mean = 110;             ///< grey level
  double contrast = 26;          ///< standard deviation, grey levels
  Eigen::Vector3d bgr{1, 1, 1};  ///< colour of the surface; scaled so that the grey level is unchanged

  bool operator==(const Material& other) const {
    return kind == other.kind && seed == other.seed && texel_m == other.texel_m && mean == other.mean &&
           contrast == other.contrast && bgr == other.bgr;
  }
};

/// A pixel's footprint on the surface: one pixel along x and along y moves the point by these [m].
struct Footprint {
  float du_dx, dv_dx;
  float du_dy, dv_dy;
};

class Texture {
 public:
  explicit Texture(const Material& material);

  /// Grey level at (u, v) [m], averaged over the pixel's footprint: trilinear in the mip chain, with several
  /// taps along the longer side of the footprint (anisotropic filtering).
  float sample(float u_m, float v_m, const Footprint& footprint) const;

 private:
  float sampleLevel(int level, float u_m, float v_m) const;
  float sampleBetween(float level, float u_m, float v_m) const;

  std::vector<cv::Mat_<uchar>> levels_;  ///< each half as wide as the one before
  float texels_per_m_;
};

}  // namespace redbee::simulation
