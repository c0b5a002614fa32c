#include "redbee/configuration/renamed_keys.hpp"

#include <algorithm>
#include <map>

namespace redbee::configuration {
namespace {

const std::map<std::string, std::string>& renamedKeys() {
  static const std::map<std::string, std::string> all{
      {"channels.inertial_state", "channels.filter_snapshot"},
      {"channels.kept_state", "channels.warm_start"},
      {"detection.objects.confirm_frames", "detection.objects.confirm_s"},
      {"detection.objects.max_missed_frames", "detection.objects.max_missed_s"},
      {"geolocation.R_CM", "camera.R_CI"},
      {"front_plane.ransac.min_inlier_share", "front_plane.ransac.min_inlier_ratio"},
      {"segmentation.nearest_depth_share", "detection.parallax.nearest_depth_fraction"},
      {"segmentation.sample_grid_px", "visual.tracker.grid_px"},
      {"visual.min_sharpness_share", "visual.min_sharpness_fraction"},
      {"visual.ransac.min_inlier_share", "visual.ransac.min_inlier_ratio"},
      {"segmentation.method", "detection.method"},
      {"segmentation.learning_frames", "detection.learning_frames"},
      {"segmentation.min_contrast", "detection.min_contrast"},
      {"segmentation.work_downscale", "detection.parallax.work_downscale"},
      {"segmentation.flow_downscale", "detection.parallax.flow_downscale"},
      {"segmentation.baseline_s", "detection.parallax.baseline_s"},
      {"segmentation.use_short_baseline", "detection.parallax.use_short_baseline"},
      {"segmentation.use_epipolar", "detection.parallax.use_epipolar"},
      {"segmentation.parallax_noise_px", "detection.parallax.noise_px"},
      {"segmentation.min_gradient", "detection.parallax.min_gradient"},
      {"segmentation.direction_error", "detection.parallax.direction_error"},
      {"segmentation.nearest_depth_fraction", "detection.parallax.nearest_depth_fraction"},
      {"segmentation.evidence_sigmas", "detection.parallax.evidence_sigmas"},
      {"segmentation.evidence_rate", "detection.parallax.evidence_rate"},
      {"segmentation.use_registration", "detection.parallax.use_registration"},
      {"segmentation.border_stretch", "detection.parallax.border_stretch"},
      {"segmentation.motion_half", "detection.parallax.motion_half"},
      {"segmentation.fill_radius_px", "detection.parallax.fill_radius_px"},
      {"segmentation.fill_contrast", "detection.parallax.fill_contrast"},
      {"segmentation.use_hole_filling", "detection.parallax.use_hole_filling"},
      {"segmentation.outline_gap_px", "detection.parallax.outline_gap_px"},
      {"segmentation.region_radius_px", "detection.parallax.region_radius_px"},
      {"segmentation.use_appearance", "detection.appearance.enabled"},
      {"segmentation.background_downscale", "detection.appearance.downscale"},
      {"segmentation.background_span_s", "detection.appearance.span_s"},
      {"segmentation.background_noise", "detection.appearance.noise"},
      {"segmentation.edge_doubt_px", "detection.appearance.edge_tolerance_px"},
      {"segmentation.use_surfaces", "detection.appearance.use_surface_reset"},
      {"segmentation.use_shadow_test", "detection.shadow.enabled"},
      {"segmentation.shadow_noise", "detection.shadow.noise"},
      {"segmentation.use_refinement", "detection.refinement.enabled"},
      {"segmentation.use_entropy", "detection.refinement.use_entropy"},
      {"segmentation.alpha", "detection.refinement.alpha"},
      {"segmentation.beta", "detection.refinement.beta"},
      {"segmentation.gamma", "detection.refinement.gamma"},
      {"segmentation.spatial_window_px", "detection.refinement.spatial_window_px"},
      {"segmentation.entropy_cell_points", "detection.refinement.entropy_cell_points"},
      {"segmentation.entropy_bins", "detection.refinement.entropy_bins"},
      {"segmentation.entropy_floor", "detection.refinement.entropy_floor"},
      {"segmentation.flow_noise_px", "detection.refinement.flow_noise_px"},
      {"segmentation.threshold", "detection.objects.threshold"},
      {"segmentation.extent_threshold", "detection.objects.extent_threshold"},
      {"segmentation.opening_px", "detection.objects.opening_px"},
      {"segmentation.closing_px", "detection.objects.closing_px"},
      {"segmentation.min_area_px", "detection.objects.min_area_px"},
      {"segmentation.max_missed_frames", "detection.objects.max_missed_s"},
      {"segmentation.confirm_frames", "detection.objects.confirm_s"},
      {"segmentation.mixture_history", "detection.two_planes.mixture_history"},
      {"segmentation.mixture_threshold", "detection.two_planes.mixture_threshold"},
      {"segmentation.canvas_margin", "detection.two_planes.canvas_margin"},
      {"segmentation.use_front_plane", "detection.two_planes.use_front_plane"},
  };
  return all;
}

}  // namespace

std::optional<std::string> renamedKey(const std::string& old_key) {
  const auto found = renamedKeys().find(old_key);
  if (found == renamedKeys().end()) return std::nullopt;
  return found->second;
}

std::string unknownKey(const std::string& key) {
  const std::optional<std::string> renamed = renamedKey(key);
  return renamed ? "was renamed to " + *renamed : "unknown key";
}

bool isRenamedSection(const std::string& name) {
  const std::string start = name + '.';
  return std::any_of(renamedKeys().begin(), renamedKeys().end(),
                     [&](const auto& entry) { return entry.first.compare(0, start.size(), start) == 0; });
}

}  // namespace redbee::configuration
