// redbee collect: writes down what running processes say.
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

/// Until SIGINT or SIGTERM. Frames heard of.
int64_t runCollect(const CollectOptions& options);

}  // namespace redbee
