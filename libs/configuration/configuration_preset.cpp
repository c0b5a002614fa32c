#include "redbee/configuration/configuration_preset.hpp"

#include <map>

#include "redbee/configuration/configuration_table.hpp"

namespace redbee::configuration {
namespace {

/// The paper as printed: constant noise in pixel units (IV.B), tracks every 16 px, and the detector with
/// its rates, which that library knows. What the paper does not specify keeps its default.
PresetValues paperValues() {
  PresetValues values{
      {"visual.tracker.grid_px", "16"},
      {"fusion.noise", "paper"},
      {"fusion.paper_Q", "[1e-2, 1e-2, 1, 1e-2, 1e-2, 1, 1e-2, 1e-2]"},
      {"fusion.paper_P0", "[1e-3, 1e-3, 1e-4, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3]"},
  };
  Configuration paper;
  paper.detection = paperDetection();
  for (const auto& setting : settings()) {
    if (setting.key.rfind("detection.", 0) == 0) values.emplace_back(setting.key, setting.text(paper));
  }
  return values;
}

/// Resets exactly the keys that the paper's preset sets.
PresetValues defaultValues() {
  PresetValues values = paperValues();
  const Configuration defaults;
  for (auto& [key, text] : values) text = findSetting(key)->text(defaults);
  return values;
}

/// Without an IMU P_FG is lower: the direction of parallax is not known, and evidence connected to the
/// image's border is suppressed. Thresholds tuned on DAVIS and UAVDT; they give no false alarms on Gull2,
/// where nothing moves.
PresetValues visionOnlyValues() {
  return {{"detection.objects.threshold", "0.25"},
          {"detection.objects.weak_threshold", "0.18"},
          {"detection.objects.neutral", "0.213"},
          {"detection.objects.extent_threshold", "0.12"}};
}

const std::map<std::string, PresetValues>& presets() {
  static const std::map<std::string, PresetValues> all{
      {"default", defaultValues()}, {"paper", paperValues()}, {"vision_only", visionOnlyValues()}};
  return all;
}

}  // namespace

const PresetValues* findPreset(const std::string& name) {
  const auto it = presets().find(name);
  return it == presets().end() ? nullptr : &it->second;
}

std::vector<std::string> presetNames() {
  std::vector<std::string> names;
  for (const auto& [name, values] : presets()) names.push_back(name);
  return names;
}

}  // namespace redbee::configuration
