// The options that several programs share, each spelled and explained once.
#pragma once

#include <filesystem>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace redbee {

/// --config FILE, required.
CLI::Option* addConfigurationOption(CLI::App& command, std::filesystem::path& file);
/// --lcm-url URL, initially LCM_DEFAULT_URL from the environment, otherwise multicast that stays on this
/// host.
CLI::Option* addLcmUrlOption(CLI::App& command, std::string& url);
/// --log FILE.
CLI::Option* addLogOption(CLI::App& command, std::filesystem::path& file);
/// --out PATH, required. `what` completes the help text: a folder or a file, and what is written there.
CLI::Option* addOutOption(CLI::App& command, std::filesystem::path& path, const std::string& what);
/// --results DIR, required; --detections is the same option.
CLI::Option* addResultsOption(CLI::App& command, std::filesystem::path& folder);

}  // namespace redbee
