// Which files a configuration is read from.
#pragma once

#include <filesystem>
#include <vector>

namespace redbee {

/// Every file that loadConfiguration(file) reads: the file, what it includes, and camera.mask. Throws
/// ConfigurationError as that does.
std::vector<std::filesystem::path> configurationFiles(const std::filesystem::path& file);

}  // namespace redbee
