// Recorded and rendered flights outside the repository; tests are skipped without them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace redbee::test {

namespace fs = std::filesystem;

/// The folder of this flight, if it exists. REDBEE_SHARED: the folder of all of them.
inline std::optional<fs::path> sharedFlight(const std::string& name) {
  const char* folder = std::getenv("REDBEE_SHARED");
  const fs::path shared =
      folder != nullptr ? fs::path(folder) : fs::path(REDBEE_SOURCE_DIR) / ".." / "shared";
  const fs::path flight = shared / "flights" / name;
  return fs::exists(flight) ? std::optional<fs::path>(flight) : std::nullopt;
}

}  // namespace redbee::test
