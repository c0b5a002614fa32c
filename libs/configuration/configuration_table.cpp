#include "redbee/configuration/configuration_table.hpp"

#include <algorithm>
#include <utility>

#include "redbee/configuration/configuration_rule.hpp"
#include "redbee/configuration/detection_settings.hpp"

namespace redbee::configuration {
namespace {

using Settings = std::vector<Setting>;

void append(Settings& settings, Settings more) {
  std::move(more.begin(), more.end(), std::back_inserter(settings));
}

#define MEMBER(path) ([](auto& configuration) -> auto& { return configuration.path; })

Settings vehicleSettings() {
  return {
      setting("vehicle", MEMBER(vehicle), notEmpty),
      setting("camera.width", MEMBER(camera.width), imageSide),
      setting("camera.height", MEMBER(camera.height), imageSide),
      setting("camera.fx", MEMBER(camera.fx), positive),
      setting("camera.fy", MEMBER(camera.fy), positive),
      setting("camera.cx", MEMBER(camera.cx), anything),
      setting("camera.cy", MEMBER(camera.cy), anything),
      setting("camera.model", MEMBER(camera.model), cameraModel),
      setting("camera.distortion", MEMBER(camera.distortion), anything),
      setting("camera.R_CI", MEMBER(inertial.extrinsics.R_CI), rotation),
      setting("camera.p_IC", MEMBER(inertial.extrinsics.p_IC), anything),
      setting("camera.timeshift_s", MEMBER(inertial.extrinsics.timeshift_s), anything),
      setting("camera.line_delay_s", MEMBER(camera.line_delay_s), lineDelay),
      setting("camera.mask", MEMBER(mask), anything),
      setting("plane.height_m", MEMBER(inertial.extrinsics.start_height_m), positive),
      setting("plane.height_sigma_m", MEMBER(inertial.extrinsics.start_height_sigma_m), positive),
      setting("imu.present", MEMBER(has_imu), anything),
      setting("imu.gyro_noise_density", MEMBER(inertial.noise.gyro_noise_density), positive),
      setting("imu.accel_noise_density", MEMBER(inertial.noise.accel_noise_density), positive),
      setting("imu.gyro_random_walk", MEMBER(inertial.noise.gyro_random_walk), notNegative),
      setting("imu.accel_random_walk", MEMBER(inertial.noise.accel_random_walk), notNegative),
      setting("imu.gyro_range", MEMBER(inertial.imu_limits.gyro_range), positive),
      setting("imu.accel_range", MEMBER(inertial.imu_limits.accel_range), positive),
      setting("imu.gyro_correction", MEMBER(inertial.gyro_correction), nearIdentity),
      setting("imu.gyro_bias", MEMBER(inertial.gyro_bias), anything),
      setting("imu.accel_bias", MEMBER(inertial.accel_bias), anything),
      setting("imu.gyro_bias_sigma", MEMBER(inertial.gyro_bias_sigma), positive),
      setting("imu.accel_bias_sigma", MEMBER(inertial.accel_bias_sigma), positive),
      setting("altimeter.present", MEMBER(has_altimeter), anything),
      setting("gimbal.enabled", MEMBER(inertial.gimbal.enabled), anything),
      setting("gimbal.angle_sigma_deg", MEMBER(inertial.gimbal.angle_sigma_deg), angleSigma),
      setting("gimbal.timeshift_s", MEMBER(inertial.gimbal.timeshift_s), anything),
      setting("gimbal.max_gap_s", MEMBER(inertial.gimbal.max_gap_s), positive),
      setting("lens.enabled", MEMBER(inertial.lens.enabled), anything),
      setting("lens.focal_length_px", MEMBER(inertial.lens.focal_length_px), notNegative),
      setting("lens.zoom_range", MEMBER(inertial.lens.zoom_range), zoomRange),
      setting("lens.focal_sigma", MEMBER(inertial.lens.focal_sigma), focalSigma),
      setting("lens.on_camera_clock", MEMBER(inertial.lens.on_camera_clock), anything),
      setting("lens.timeshift_s", MEMBER(inertial.lens.timeshift_s), anything),
      setting("lens.max_gap_s", MEMBER(inertial.lens.max_gap_s), positive),
  };
}

Settings inertialSettings() {
  return {
      setting("inertial.gravity", MEMBER(inertial.gravity), positive),
      setting("inertial.start_velocity_sigma", MEMBER(inertial.start_velocity_sigma), positive),
      setting("inertial.extrinsic_rotation_sigma_deg", MEMBER(inertial.extrinsic_rotation_sigma_deg),
              notNegative),
      setting("inertial.gravity_gate", MEMBER(inertial.gravity_gate), notNegative),
      setting("inertial.gravity_sigma", MEMBER(inertial.gravity_sigma), positive),
      setting("inertial.gravity_correlation_s", MEMBER(inertial.gravity_correlation_s), positive),
      setting("inertial.max_imu_gap_s", MEMBER(inertial.max_imu_gap_s), positive),
      setting("inertial.max_frame_gap_s", MEMBER(inertial.max_frame_gap_s), positive),
      setting("inertial.feedback_correlation_frames", MEMBER(inertial.feedback_correlation_frames), positive),
      setting("inertial.innovation_gate_probability", MEMBER(inertial.innovation_gate_probability),
              probability),
  };
}

template <typename Access>
Settings ransacSettings(const std::string& section, Access ransac) {
  const auto member = [ransac](auto field) {
    return [ ransac, field ](auto& configuration) -> auto& { return ransac(configuration).*field; };
  };
  using P = RansacParameters;
  return {
      setting(section + ".inlier_px", member(&P::inlier_px), positive),
      setting(section + ".max_iterations", member(&P::max_iterations), positive),
      setting(section + ".confidence", member(&P::confidence), probability),
      setting(section + ".min_inliers", member(&P::min_inliers), fourOrMore),
      setting(section + ".min_inlier_ratio", member(&P::min_inlier_ratio), fraction),
      setting(section + ".min_spread", member(&P::min_spread), fraction),
      setting(section + ".seed", member(&P::seed), anything),
  };
}

Settings trackerSettings() {
  return {
      setting("visual.tracker.grid_px", MEMBER(visual.tracker.grid_px), positive),
      setting("visual.tracker.window_px", MEMBER(visual.tracker.window_px), odd),
      setting("visual.tracker.levels", MEMBER(visual.tracker.levels), pyramid),
      setting("visual.tracker.iterations", MEMBER(visual.tracker.iterations), positive),
      setting("visual.tracker.epsilon_px", MEMBER(visual.tracker.epsilon_px), positive),
      setting("visual.tracker.min_eigenvalue", MEMBER(visual.tracker.min_eigenvalue), notNegative),
      setting("visual.tracker.max_forward_backward_px", MEMBER(visual.tracker.max_forward_backward_px),
              positive),
      setting("visual.tracker.max_residual", MEMBER(visual.tracker.max_residual), positive),
  };
}

Settings visualSettings() {
  Settings settings{
      setting("visual.max_frame_gap_s", MEMBER(visual.max_frame_gap_s), positive),
      setting("visual.min_sharpness", MEMBER(visual.min_sharpness), notNegative),
      setting("visual.min_sharpness_fraction", MEMBER(visual.min_sharpness_fraction), fraction),
  };
  append(settings, trackerSettings());
  append(settings, ransacSettings("visual.ransac", MEMBER(visual.ransac)));
  append(settings, {setting("front_plane.ground_px", MEMBER(front.ground_px), positive),
                    setting("front_plane.min_separation_px", MEMBER(front.min_separation_px), notNegative)});
  append(settings, ransacSettings("front_plane.ransac", MEMBER(front.ransac)));
  return settings;
}

Settings fusionSettings() {
  return {
      setting("fusion.noise", MEMBER(fusion.noise), anything),
      setting("fusion.paper_Q", MEMBER(fusion.paper_Q), variances),
      setting("fusion.paper_P0", MEMBER(fusion.paper_P0), variances),
      setting("fusion.gate_probability", MEMBER(fusion.gate_probability), probability),
      setting("fusion.max_gated_in_a_row", MEMBER(fusion.max_gated_in_a_row), positive),
      setting("fusion.min_overlap", MEMBER(fusion.min_overlap), fraction),
      setting("fusion.visual_inflation", MEMBER(fusion.visual_inflation), positive),
      setting("fusion.process_inflation", MEMBER(fusion.process_inflation), positive),
  };
}

Settings messagingSettings() {
  return {
      setting("channels.camera", MEMBER(channels.camera), channelName),
      setting("channels.imu", MEMBER(channels.imu), channelName),
      setting("channels.altimeter", MEMBER(channels.altimeter), channelName),
      setting("channels.inertial_homography", MEMBER(channels.inertial_homography), channelName),
      setting("channels.filter_snapshot", MEMBER(channels.filter_snapshot), channelName),
      setting("channels.warm_start", MEMBER(channels.warm_start), channelName),
      setting("channels.visual_homography", MEMBER(channels.visual_homography), channelName),
      setting("channels.fused_homography", MEMBER(channels.fused_homography), channelName),
      setting("channels.foreground", MEMBER(channels.foreground), channelName),
      setting("channels.detections", MEMBER(channels.detections), channelName),
      setting("channels.overlay", MEMBER(channels.overlay), channelName),
      setting("channels.health", MEMBER(channels.health), channelName),
      setting("channels.pose", MEMBER(channels.pose), channelName),
      setting("channels.gimbal", MEMBER(channels.gimbal), channelName),
      setting("channels.lens", MEMBER(channels.lens), channelName),
      setting("channels.autopilot_clock", MEMBER(channels.autopilot_clock), channelName),
      setting("channels.targets", MEMBER(channels.targets), channelName),
      setting("waits.inertial_s", MEMBER(waits.inertial_s), notNegative),
      setting("waits.visual_s", MEMBER(waits.visual_s), notNegative),
      setting("waits.fusion_s", MEMBER(waits.fusion_s), notNegative),
      setting("waits.segmentation_s", MEMBER(waits.segmentation_s), notNegative),
      setting("watch.hang_timeout_s", MEMBER(watch.hang_timeout_s), hangTimeout),
      setting("overlay.period_frames", MEMBER(overlay_period_frames), notNegative),
  };
}

Settings driverSettings() {
  return {
      setting("capture.pipeline", MEMBER(capture.pipeline), anything),
      setting("capture.rate_hz", MEMBER(capture.rate_hz), rateOrAny),
      setting("capture.jpeg_quality", MEMBER(capture.jpeg_quality), percent),
      setting("capture.stamp", MEMBER(capture.stamp), stampedEvent),
      setting("capture.exposure_s", MEMBER(capture.exposure_s), zeroTo(1)),
      setting("autopilot.link", MEMBER(autopilot.link), autopilotLink),
      setting("autopilot.system_id", MEMBER(autopilot.system_id), systemId),
      setting("autopilot.signing_key_file", MEMBER(autopilot.signing_key_file), absolutePath),
      setting("autopilot.imu_rate_hz", MEMBER(autopilot.imu_rate_hz), rate),
      setting("autopilot.attitude_rate_hz", MEMBER(autopilot.attitude_rate_hz), rate),
      setting("autopilot.position_rate_hz", MEMBER(autopilot.position_rate_hz), rate),
      setting("autopilot.attitude_sigma_deg", MEMBER(autopilot.attitude_sigma_deg), angleSigma),
      setting("autopilot.heading_sigma_deg", MEMBER(autopilot.heading_sigma_deg), angleSigma),
      setting("autopilot.rangefinder_above_camera_m", MEMBER(autopilot.rangefinder_above_camera_m), mounting),
      setting("serve.listen", MEMBER(serve.listen), listenAddress),
      setting("serve.token_file", MEMBER(serve.token_file), absolutePath),
      setting("serve.allow_writes", MEMBER(serve.allow_writes), anything),
  };
}

Settings geolocationSettings() {
  return {
      setting("geolocation.enabled", MEMBER(geolocation.enabled), anything),
      setting("geolocation.mount", MEMBER(geolocation.mount), cameraMount),
      setting("geolocation.mount_sigma_deg", MEMBER(geolocation.mount_sigma_deg), angleSigma),
      setting("geolocation.pixel_sigma_px", MEMBER(geolocation.pixel_sigma_px), positiveTo(1000)),
      setting("geolocation.foot_sigma", MEMBER(geolocation.foot_sigma), fraction),
      setting("geolocation.height_over_length", MEMBER(geolocation.height_over_length), zeroTo(100)),
      setting("geolocation.focal_sigma", MEMBER(geolocation.focal_sigma), fraction),
      setting("geolocation.home_height_sigma_m", MEMBER(geolocation.home_height_sigma_m), positiveTo(10'000)),
      setting("geolocation.ground_slope_sigma_deg", MEMBER(geolocation.ground_slope_sigma_deg), slopeSigma),
      setting("geolocation.error_correlation_s", MEMBER(geolocation.error_correlation_s),
              positiveTo(100'000)),
      setting("geolocation.acceleration_sigma", MEMBER(geolocation.acceleration_sigma), positiveTo(1000)),
      setting("geolocation.max_pose_age_s", MEMBER(geolocation.max_pose_age_s), positiveTo(60)),
      setting("geolocation.min_depression_deg", MEMBER(geolocation.min_depression_deg), depression),
      setting("geolocation.keep_stopped_s", MEMBER(geolocation.keep_stopped_s), zeroTo(100'000)),
      setting("ground_link.link", MEMBER(ground_link.link), autopilotLink),
      setting("ground_link.system_id", MEMBER(ground_link.system_id), systemId),
      setting("ground_link.component_id", MEMBER(ground_link.component_id), systemId),
      setting("ground_link.signing_key_file", MEMBER(ground_link.signing_key_file), absolutePath),
      setting("ground_link.rate_hz", MEMBER(ground_link.rate_hz), rate),
  };
}

#undef MEMBER

Settings makeSettings() {
  Settings settings = vehicleSettings();
  append(settings, inertialSettings());
  append(settings, visualSettings());
  append(settings, fusionSettings());
  append(settings, detectionSettings());
  append(settings, messagingSettings());
  append(settings, driverSettings());
  append(settings, geolocationSettings());
  return settings;
}

}  // namespace

const std::vector<Setting>& settings() {
  static const Settings table = makeSettings();
  return table;
}

const Setting* findSetting(const std::string& key) {
  const auto it =
      std::find_if(settings().begin(), settings().end(), [&](const Setting& s) { return s.key == key; });
  return it == settings().end() ? nullptr : &*it;
}

bool isSection(const std::string& name) {
  const std::string start = name + '.';
  return std::any_of(settings().begin(), settings().end(),
                     [&](const Setting& s) { return s.key.compare(0, start.size(), start) == 0; });
}

}  // namespace redbee::configuration
