#include "redbee/configuration/detection_settings.hpp"

#include <algorithm>

#include "redbee/configuration/configuration_rule.hpp"
#include "redbee/detection/detector.hpp"

namespace redbee::configuration {
namespace {

bool isDetector(const std::string& name) {
  const std::vector<std::string> names = detectorNames();
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

#define MEMBER(path) ([](auto& configuration) -> auto& { return configuration.detection.path; })

std::vector<Setting> detectionSettings() {
  const Rule<bool (*)(const std::string&)> detector{isDetector, "must be one of " + listOf(detectorNames())};
  return {
      setting("detection.method", MEMBER(method), detector),
      setting("detection.learning_frames", MEMBER(learning_frames), notNegative),
      setting("detection.min_contrast", MEMBER(min_contrast), notNegative),
      setting("detection.parallax.work_downscale", MEMBER(parallax.work_downscale), halving),
      setting("detection.parallax.flow_downscale", MEMBER(parallax.flow_downscale), halving),
      setting("detection.parallax.baseline_s", MEMBER(parallax.baseline_s), positive),
      setting("detection.parallax.use_short_baseline", MEMBER(parallax.use_short_baseline), anything),
      setting("detection.parallax.use_epipolar", MEMBER(parallax.use_epipolar), anything),
      setting("detection.parallax.use_epipole", MEMBER(parallax.use_epipole), anything),
      setting("detection.parallax.noise_px", MEMBER(parallax.noise_px), positive),
      setting("detection.parallax.min_gradient", MEMBER(parallax.min_gradient), positive),
      setting("detection.parallax.photometric_noise", MEMBER(parallax.photometric_noise), notNegative),
      setting("detection.parallax.direction_error", MEMBER(parallax.direction_error), notNegative),
      setting("detection.parallax.nearest_depth_fraction", MEMBER(parallax.nearest_depth_fraction), fraction),
      setting("detection.parallax.evidence_sigmas", MEMBER(parallax.evidence_sigmas), positive),
      setting("detection.parallax.evidence_rate", MEMBER(parallax.evidence_rate), fraction),
      setting("detection.parallax.use_point_paths", MEMBER(parallax.use_point_paths), anything),
      setting("detection.parallax.use_registration", MEMBER(parallax.use_registration), anything),
      setting("detection.parallax.border_stretch", MEMBER(parallax.border_stretch), fraction),
      setting("detection.parallax.motion_half", MEMBER(parallax.motion_half), positive),
      setting("detection.parallax.fill_radius_px", MEMBER(parallax.fill_radius_px), positive),
      setting("detection.parallax.fill_contrast", MEMBER(parallax.fill_contrast), positive),
      setting("detection.parallax.use_hole_filling", MEMBER(parallax.use_hole_filling), anything),
      setting("detection.parallax.outline_gap_px", MEMBER(parallax.outline_gap_px), notNegative),
      setting("detection.parallax.region_radius_px", MEMBER(parallax.region_radius_px), notNegative),
      setting("detection.appearance.enabled", MEMBER(appearance.enabled), anything),
      setting("detection.appearance.downscale", MEMBER(appearance.downscale), halving),
      setting("detection.appearance.span_s", MEMBER(appearance.span_s), positive),
      setting("detection.appearance.noise", MEMBER(appearance.noise), positive),
      setting("detection.appearance.edge_tolerance_px", MEMBER(appearance.edge_tolerance_px), notNegative),
      setting("detection.appearance.use_surface_reset", MEMBER(appearance.use_surface_reset), anything),
      setting("detection.appearance.use_candidates", MEMBER(appearance.use_candidates), anything),
      setting("detection.shadow.enabled", MEMBER(shadow.enabled), anything),
      setting("detection.shadow.noise", MEMBER(shadow.noise), positive),
      setting("detection.refinement.enabled", MEMBER(refinement.enabled), anything),
      setting("detection.refinement.use_entropy", MEMBER(refinement.use_entropy), anything),
      setting("detection.refinement.alpha", MEMBER(refinement.alpha), fraction),
      setting("detection.refinement.beta", MEMBER(refinement.beta), fraction),
      setting("detection.refinement.gamma", MEMBER(refinement.gamma), fraction),
      setting("detection.refinement.spatial_window_px", MEMBER(refinement.spatial_window_px), odd),
      setting("detection.refinement.entropy_cell_points", MEMBER(refinement.entropy_cell_points), positive),
      setting("detection.refinement.entropy_bins", MEMBER(refinement.entropy_bins), atLeastTwo),
      setting("detection.refinement.entropy_floor", MEMBER(refinement.entropy_floor), positive),
      setting("detection.refinement.flow_noise_px", MEMBER(refinement.flow_noise_px), notNegative),
      setting("detection.objects.threshold", MEMBER(objects.threshold), fraction),
      setting("detection.objects.weak_threshold", MEMBER(objects.weak_threshold), fraction),
      setting("detection.objects.neutral", MEMBER(objects.neutral), fraction),
      setting("detection.objects.extent_threshold", MEMBER(objects.extent_threshold), fraction),
      setting("detection.objects.opening_px", MEMBER(objects.opening_px), notNegative),
      setting("detection.objects.closing_px", MEMBER(objects.closing_px), notNegative),
      setting("detection.objects.min_area_px", MEMBER(objects.min_area_px), notNegative),
      setting("detection.objects.max_missed_s", MEMBER(objects.max_missed_s), notNegative),
      setting("detection.objects.confirm_s", MEMBER(objects.confirm_s), notNegative),
      setting("detection.two_planes.mixture_history", MEMBER(two_planes.mixture_history), positive),
      setting("detection.two_planes.mixture_threshold", MEMBER(two_planes.mixture_threshold), positive),
      setting("detection.two_planes.canvas_margin", MEMBER(two_planes.canvas_margin), fraction),
      setting("detection.two_planes.use_front_plane", MEMBER(two_planes.use_front_plane), anything),
  };
}

#undef MEMBER

}  // namespace redbee::configuration
