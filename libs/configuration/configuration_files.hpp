// Which files a configuration is read from.
#pragma once

#include <filesystem>
#include <vector>

namespace redbee {

/// Every file that loadConfiguration(file) reads: the file, what it includes, and camera.mask. Throws
/// ConfigurationError as that does.
std::vector<std::filesystem::path> configurationFiles(const std::filesystem::path& file);

/// Throws InputError if `output` is one of `others` or one of those files: writing would destroy it.
void requireNoInput(const std::filesystem::path& output, const std::filesystem::path& configuration,
                    std::vector<std::filesystem::path> others);

}  // namespace redbee
