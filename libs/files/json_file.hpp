// Reads and writes JSON files.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace redbee {

/// Throws InputError if the file is missing or is not JSON.
nlohmann::json readJson(const std::filesystem::path& file);
/// Indented by two. Throws InputError if the file cannot be written.
void writeJson(const std::filesystem::path& file, const nlohmann::json& json);

}  // namespace redbee
