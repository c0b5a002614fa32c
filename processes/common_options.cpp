#include "processes/common_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "redbee/bus/receive_buffer.hpp"

namespace redbee {

CLI::Option* addConfigurationOption(CLI::App& command, std::filesystem::path& file) {
  return command.add_option("--config", file, "configuration of the vehicle, a YAML file")->required();
}

CLI::Option* addLcmUrlOption(CLI::App& command, std::string& url) {
  url = kDefaultLcmUrl;
  return command.add_option("--lcm-url", url, "LCM network to use")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str();
}

CLI::Option* addLogOption(CLI::App& command, std::filesystem::path& file) {
  return command.add_option("--log", file, "recorded flight, an LCM log");
}

CLI::Option* addOutOption(CLI::App& command, std::filesystem::path& path, const std::string& what) {
  return command.add_option("--out", path, what)->required();
}

CLI::Option* addResultsOption(CLI::App& command, std::filesystem::path& folder) {
  return command
      .add_option("--results,--detections", folder, "results of a run of detect or collect, a folder")
      ->required();
}

std::function<std::string(const std::string&)> numberFrom(double low, double high) {
  return [low, high](const std::string& text) {
    double value = 0;
    const bool is_within = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
    return is_within ? "" : fmt::format("'{}' is no number from {} to {}", text, low, high);
  };
}

}  // namespace redbee
