// Command-line options that several programs have in common.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace redbee {

/// --config FILE, required.
CLI::Option* addConfigurationOption(CLI::App& command, std::filesystem::path& file);
/// --lcm-url URL; default: LCM_DEFAULT_URL from the environment, otherwise multicast on this host only.
CLI::Option* addLcmUrlOption(CLI::App& command, std::string& url);
/// --log FILE.
CLI::Option* addLogOption(CLI::App& command, std::filesystem::path& file);
/// --out PATH, required. `what` completes the help text: a folder or a file, and what is written there.
CLI::Option* addOutOption(CLI::App& command, std::filesystem::path& path, const std::string& what);
/// --results DIR, required; --detections is an alias.
CLI::Option* addResultsOption(CLI::App& command, std::filesystem::path& folder);

/// For CLI::Option::check(): a number from `low` to `high`. CLI::Range and CLI::PositiveNumber let "nan"
/// pass.
std::function<std::string(const std::string&)> numberFrom(double low, double high);

}  // namespace redbee
