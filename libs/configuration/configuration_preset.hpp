// Presets: the keys that each one sets; internal to the configuration.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace redbee::configuration {

/// Key and YAML text of its value.
using PresetValues = std::vector<std::pair<std::string, std::string>>;

/// nullptr if there is no preset of this name.
const PresetValues* findPreset(const std::string& name);
std::vector<std::string> presetNames();

}  // namespace redbee::configuration
