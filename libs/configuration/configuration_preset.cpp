#include "redbee/configuration/configuration_preset.hpp"

#include <map>

#include "redbee/configuration/configuration_table.hpp"

namespace redbee::configuration {
namespace {

/// The paper as printed: constant noise in pixel units (IV.B), tracks every 16 px, and the segmentation with
/// its rates, which that library knows. What the paper does not specify keeps its default.
PresetValues paperValues() {
  PresetValues values{
      {"visual.tracker.grid_px", "16"},
      {"fusion.noise", "paper"},
      {"fusion.paper_Q", "[1e-2, 1e-2, 1, 1e-2, 1e-2, 1, 1e-2, 1e-2]"},
      {"fusion.paper_P0", "[1e-3, 1e-3, 1e-4, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3]"},
  };
  Configuration paper;
  paper.segmentation = paperSegmentation();
  for (const auto& setting : settings()) {
    if (setting.key.rfind("segmentation.", 0) == 0) values.emplace_back(setting.key, setting.text(paper));
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

}  // namespace

const PresetValues* findPreset(const std::string& name) {
  static const std::map<std::string, PresetValues> presets{{"default", defaultValues()},
                                                           {"paper", paperValues()}};
  const auto it = presets.find(name);
  return it == presets.end() ? nullptr : &it->second;
}

}  // namespace redbee::configuration
