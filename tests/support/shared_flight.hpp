// Recorded and rendered flights outside the repository; tests are skipped without them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace redbee::test {

namespace fs = std::filesystem;

/// REDBEE_SHARED: the folder of all of them.
inline std::optional<fs::path> sharedFile(const fs::path& name) {
  const char* folder = std::getenv("REDBEE_SHARED");
  const fs::path shared =
      folder != nullptr ? fs::path(folder) : fs::path(REDBEE_SOURCE_DIR) / ".." / "shared";
  return fs::exists(shared / name) ? std::optional<fs::path>(shared / name) : std::nullopt;
}

/// The folder of this flight, if it exists.
inline std::optional<fs::path> sharedFlight(const std::string& name) {
  return sharedFile(fs::path("flights") / name);
}

/// An input of a kind that users have, if it exists: a file or a folder.
inline std::optional<fs::path> sharedCase(const std::string& name) {
  return sharedFile(fs::path("cases") / name);
}

}  // namespace redbee::test
