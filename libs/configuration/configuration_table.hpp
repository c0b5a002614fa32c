// The table of all keys; internal to the configuration.
#pragma once

#include <yaml-cpp/yaml.h>

#include <functional>
#include <string>
#include <vector>

#include "redbee/configuration/configuration.hpp"

namespace redbee::configuration {

/// One key of the file and the member that it fills.
struct Setting {
  std::string key;  ///< with its sections: visual.tracker.grid_px
  /// Throws ValueError where the value has the wrong type or breaks the key's rule.
  std::function<void(Configuration&, const YAML::Node&)> read;
  std::function<std::string(const Configuration&)> text;
};

/// Ordered so that the keys of a section stand together.
const std::vector<Setting>& settings();
/// Null where there is no such key.
const Setting* findSetting(const std::string& key);
/// True where keys begin with `name` and a dot.
bool isSection(const std::string& name);

}  // namespace redbee::configuration
