// Presets, as the keys that they set; internal to the configuration.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace redbee::configuration {

/// Key and YAML text of its value.
using PresetValues = std::vector<std::pair<std::string, std::string>>;

/// Null for a name that is no preset.
const PresetValues* findPreset(const std::string& name);
std::vector<std::string> presetNames();

}  // namespace redbee::configuration
