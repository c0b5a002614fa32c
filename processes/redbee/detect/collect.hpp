// redbee collect: saves the results of running processes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace redbee {

struct CollectOptions {
  std::filesystem::path configuration;
  std::filesystem::path out;
  std::string url;
};

/// Runs until SIGINT or SIGTERM. Returns the number of frames received.
int64_t runCollect(const CollectOptions& options);

}  // namespace redbee
