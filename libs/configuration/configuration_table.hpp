// The table of all keys; internal to the configuration.
#pragma once

#include <yaml-cpp/yaml.h>

#include <functional>
#include <string>
#include <vector>

#include "redbee/configuration/configuration.hpp"

namespace redbee::configuration {

/// One key of the file and the member that it sets.
struct Setting {
  std::string key;  ///< with its sections: visual.tracker.grid_px
  /// Throws ValueError if the value has the wrong type or violates the key's rule.
  std::function<void(Configuration&, const YAML::Node&)> read;
  std::function<std::string(const Configuration&)> text;
};

/// The keys of a section are adjacent.
const std::vector<Setting>& settings();
/// nullptr if there is no such key.
const Setting* findSetting(const std::string& key);
/// True if any key begins with `name` and a dot.
bool isSection(const std::string& name);

}  // namespace redbee::configuration
