#include "redbee/files/json_file.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {

nlohmann::json readJson(const std::filesystem::path& file) {
  requireFile(file);
  std::ifstream stream(file);
  if (!stream) throw InputError(file, "cannot be read");
  try {
    return nlohmann::json::parse(stream);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file, error.what());
  }
}

void writeJson(const std::filesystem::path& file, const nlohmann::json& json) {
  writeAtomically(file, json.dump(2) + "\n");
}

}  // namespace redbee
