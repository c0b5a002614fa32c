#include "redbee/detection/objects/region_features.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "redbee/detection/objects/outline_contrast.hpp"
#include "redbee/imaging/chamfer_distance.hpp"

namespace redbee {
namespace {

constexpr float kNearBegins_px = 3, kFarBegins_px = 7, kFarEnds_px = 16;  // of the image, around the region
constexpr double kGrazing =
    0.02;  // of ray and the ground's normal, the ray's depth 1: closer to the horizon counts as this
constexpr size_t kOwn = 0, kNear = 1, kFar = 2, kRings = 3;
constexpr size_t kGround = 0, kAppearance = 1, kMotion = 2, kForeground = 3, kMaps = 4;

/// Of one map in one ring.
struct RingSum {
  int sum = 0;
  int most = 0;

  void add(int value) {
    sum += value;
    most = std::max(most, value);
  }
};

struct RingSums {
  std::array<std::array<RingSum, kRings>, kMaps> of{};
  std::array<int, kRings> count{};

  float mean(size_t map, size_t ring) const {
    if (count[ring] == 0) return std::numeric_limits<float>::quiet_NaN();
    return static_cast<float>(static_cast<double>(of[map][ring].sum) / count[ring]);
  }
};

size_t ringAt(float distance, float scale) {
  if (distance == 0) return kOwn;
  if (distance <= kNearBegins_px / scale || distance > kFarEnds_px / scale) return kRings;
  return distance <= kFarBegins_px / scale ? kNear : kFar;
}

/// `distance`: of each pixel of `around` from the region.
RingSums sumsOf(const ForegroundMaps& maps, const cv::Rect& around, const cv::Mat1f& distance, float scale) {
  RingSums sums;
  for (int y = 0; y < around.height; ++y) {
    const float* const distances = distance[y];
    const uint8_t* const ground = maps.ground[around.y + y] + around.x;
    const uint8_t* const appearance = maps.appearance[around.y + y] + around.x;
    const uint8_t* const motion = maps.motion[around.y + y] + around.x;
    for (int x = 0; x < around.width; ++x) {
      const size_t ring = ringAt(distances[x], scale);
      if (ring == kRings) continue;
      ++sums.count[ring];
      sums.of[kGround][ring].add(ground[x]);
      sums.of[kAppearance][ring].add(appearance[x]);
      sums.of[kMotion][ring].add(motion[x]);
      sums.of[kForeground][ring].add(appearance[x] * motion[x] / 255);
    }
  }
  return sums;
}

}  // namespace

const std::array<const char*, kRegionFeatures> kRegionFeatureNames{
    "level",          "log_area",        "fill",
    "at_border",      "ground_own",      "ground_near",
    "ground_far",     "appearance_own",  "appearance_near",
    "appearance_far", "motion_own",      "motion_near",
    "motion_far",     "foreground_own",  "foreground_near",
    "foreground_far", "ground_most",     "foreground_most",
    "log_width_m",    "log_height_m",    "appearance_most",
    "contrast_least", "contrast_second", "contrast_median",
    "contrast_mean"};

RegionMeter::RegionMeter(const ForegroundMaps& maps, cv::Size image, const std::optional<GroundPlane>& ground)
    : maps_(maps),
      ground_(ground),
      scale_(static_cast<double>(image.width) / maps.appearance.cols),
      outside_(maps.appearance.size()),
      inside_(maps.appearance.size()) {}

RegionFeatures RegionMeter::measure(const cv::Rect& box, const cv::Mat1b& pixels, size_t level) {
  RegionFeatures features;
  features.fill(std::numeric_limits<float>::quiet_NaN());
  const auto set = [&](RegionFeature feature, double value) {
    features[static_cast<size_t>(feature)] = static_cast<float>(value);
  };
  const cv::Size size = maps_.appearance.size();
  const int reach = static_cast<int>(std::ceil(kFarEnds_px / scale_)) + 1;
  const cv::Rect around =
      cv::Rect(box.x - reach, box.y - reach, box.width + 2 * reach, box.height + 2 * reach) &
      cv::Rect({}, size);
  if (maps_.complete_ground) maps_.complete_ground(around);
  const cv::Mat1f distance = outside_(cv::Rect({}, around.size()));
  distanceOutside(box - around.tl(), pixels, distance);
  const RingSums sums = sumsOf(maps_, around, distance, static_cast<float>(scale_));
  const double area_px = sums.count[kOwn] * scale_ * scale_;

  using F = RegionFeature;
  set(F::kLevel, static_cast<double>(level));
  set(F::kLogArea, std::log(area_px));
  set(F::kFill, static_cast<double>(sums.count[kOwn]) / box.area());
  set(F::kAtBorder,
      box.x <= 1 || box.y <= 1 || box.br().x >= size.width - 1 || box.br().y >= size.height - 1);
  for (size_t map = 0; map < kMaps; ++map) {
    for (size_t ring = 0; ring < kRings; ++ring) {
      features[static_cast<size_t>(F::kGroundOwn) + kRings * map + ring] = sums.mean(map, ring);
    }
  }
  set(F::kGroundMost, sums.of[kGround][kOwn].most);
  set(F::kForegroundMost, sums.of[kForeground][kOwn].most);
  set(F::kAppearanceMost, sums.of[kAppearance][kOwn].most);
  if (ground_) {
    const Eigen::Vector3d foot(scale_ * (box.x + 0.5 * box.width), scale_ * box.br().y, 1);
    const Eigen::Vector3d ray = ground_->K.inverse() * foot;
    const double depth_m = ground_->height_m / std::max(ground_->normal.dot(ray), kGrazing);
    set(F::kLogWidth_m, std::log(box.width * scale_ * depth_m / ground_->K(0, 0)));
    set(F::kLogHeight_m, std::log(box.height * scale_ * depth_m / ground_->K(1, 1)));
  }
  const cv::Mat1f depth = inside_(cv::Rect({}, box.size()));
  distanceInside(pixels, depth);
  const auto in_maps = [&](float px) { return px / static_cast<float>(scale_); };
  const OutlineContrast contrast = outlineContrast(maps_.colours, box, depth, around, distance,
                                                   {in_maps(kNearBegins_px), in_maps(kFarBegins_px)});
  set(F::kContrastLeast, contrast.least);
  set(F::kContrastSecond, contrast.second);
  set(F::kContrastMedian, contrast.median);
  set(F::kContrastMean, contrast.mean);
  return features;
}

}  // namespace redbee
