// Any bytes as an MCAP file: imported, up to its damage, or refused.
#include "redbee/files/input_error.hpp"
#include "redbee/importers/mcap/import_mcap.hpp"
#include "tests/fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const fuzz::Folder folder;
  ImportOptions options;
  options.source = folder.write("f.mcap", std::string(reinterpret_cast<const char*>(data), size));
  options.log = folder / "flight.lcm";
  options.keep_going = true;
  Progress progress("", "", true);
  try {
    const ImportSummary summary = mcapImporter().import(options, progress);
  } catch (const InputError&) {
  }
  return 0;
}
