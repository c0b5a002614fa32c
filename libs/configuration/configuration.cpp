#include "redbee/configuration/configuration.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "redbee/configuration/configuration_files.hpp"
#include "redbee/configuration/configuration_loader.hpp"
#include "redbee/configuration/configuration_preset.hpp"
#include "redbee/configuration/configuration_table.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

std::vector<std::string> splitKey(const std::string& key) {
  std::vector<std::string> parts;
  size_t start = 0;
  for (size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', start)) {
    parts.push_back(key.substr(start, dot - start));
    start = dot + 1;
  }
  parts.push_back(key.substr(start));
  return parts;
}

configuration::Loader loaded(const std::filesystem::path& file, const ConfigurationOverrides& overrides) {
  configuration::Loader loader;
  loader.loadFile(file);
  loader.applyOverrides(overrides);
  loader.checkWhole(file);
  loader.loadMask();
  return loader;
}

}  // namespace

Configuration loadConfiguration(const std::filesystem::path& file) { return loadConfiguration(file, {}); }

Configuration loadConfiguration(const std::filesystem::path& file, const ConfigurationOverrides& overrides) {
  return loaded(file, overrides).configuration();
}

std::vector<std::filesystem::path> configurationFiles(const std::filesystem::path& file) {
  return loaded(file, {}).files();
}

void requireNoInput(const std::filesystem::path& output, const std::filesystem::path& configuration,
                    std::vector<std::filesystem::path> others) {
  const auto files = configurationFiles(configuration);
  others.insert(others.end(), files.begin(), files.end());
  requireNoInput(output, others);
}

std::vector<std::string> presetNames() { return configuration::presetNames(); }

std::string emitYaml(const Configuration& configuration) {
  return emitYaml(configuration, configurationKeys());
}

std::string emitYaml(const Configuration& configuration, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    if (configuration::findSetting(key) == nullptr) throw std::invalid_argument("emitYaml: no key " + key);
  }
  std::string yaml;
  std::vector<std::string> open;
  for (const auto& setting : configuration::settings()) {
    if (std::find(keys.begin(), keys.end(), setting.key) == keys.end()) continue;
    const auto parts = splitKey(setting.key);
    const auto sections_end = parts.end() - 1;
    const auto shared = static_cast<size_t>(
        std::mismatch(open.begin(), open.end(), parts.begin(), sections_end).first - open.begin());
    open.assign(parts.begin(), sections_end);
    for (size_t depth = shared; depth < open.size(); ++depth) {
      yaml += std::string(2 * depth, ' ') + open[depth] + ":\n";
    }
    yaml += std::string(2 * open.size(), ' ') + parts.back() + ": " + setting.text(configuration) + "\n";
  }
  return yaml;
}

std::string configurationHash(const Configuration& configuration) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const char c : emitYaml(configuration)) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

std::vector<std::string> configurationKeys() {
  std::vector<std::string> keys;
  for (const auto& setting : configuration::settings()) keys.push_back(setting.key);
  return keys;
}

}  // namespace redbee
