// A vehicle's YAML file with any content: read, or refused in one line.
#include "redbee/configuration/configuration.hpp"
#include "tests/fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const fuzz::Folder folder;
  const std::string text(reinterpret_cast<const char*>(data), size);
  // Includes would read arbitrary files; they have their own tests.
  if (text.find("include") != std::string::npos) return 0;
  const auto file = folder.write("vehicle.yaml", text);
  try {
    configurationHash(loadConfiguration(file));
  } catch (const ConfigurationError& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) __builtin_trap();
  }
  return 0;
}
