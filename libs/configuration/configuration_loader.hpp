// Loads YAML files into a Configuration; internal to the configuration.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "redbee/configuration/configuration.hpp"

namespace redbee::configuration {

/// Reads a file and its includes; records where each key was last set, for errors that involve several keys.
class Loader {
 public:
  /// All functions throw ConfigurationError.
  void loadFile(const std::filesystem::path& file);
  void applyOverrides(const ConfigurationOverrides& overrides);
  /// Checks that involve several keys: a missing camera, the wrong number of distortion coefficients,
  /// duplicate channel names, timeouts in the wrong order, an extent threshold above its threshold.
  void checkWhole(const std::filesystem::path& file) const;
  /// Reads camera.mask. To be called after checkWhole().
  void loadMask();
  const Configuration& configuration() const { return configuration_; }
  /// What was read so far.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  struct Place {
    std::string file;
    int line = 1;  ///< 0: not of a file
  };

  void checkCamera() const;
  [[noreturn]] static void fail(const Place& place, const std::string& key, const std::string& what);
  Place placeOf(const YAML::Node& node) const;
  void applyIncludes(const YAML::Node& root);
  void includeOne(const YAML::Node& name);
  void applyPreset(const YAML::Node& root);
  void applyPreset(const std::string& name, const Place& place);
  void applySection(const YAML::Node& section, const std::string& prefix);
  void applyEntry(const YAML::Node& name, const YAML::Node& value, const std::string& key);
  void apply(const std::string& key, const YAML::Node& value, const Place& place);
  const std::string& changed(const std::string& first, const std::string& second) const;
  void checkWaits() const;
  void checkThresholds() const;
  void checkMount() const;

  Configuration configuration_;
  std::map<std::string, Place> places_;
  std::vector<std::filesystem::path> open_files_;  ///< the file being read is the last
  std::vector<std::filesystem::path> files_;
};

}  // namespace redbee::configuration
