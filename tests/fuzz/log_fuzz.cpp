// An LCM log with any content: read to its end, twice the same.
#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace redbee {
namespace {

int64_t countEvents(LogReader& log) {
  int64_t events = 0;
  while (log.next()) ++events;
  return events;
}

}  // namespace
}  // namespace redbee

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const fuzz::Folder folder;
  const auto file = folder.write("flight.lcm", std::string(reinterpret_cast<const char*>(data), size));
  try {
    LogReader log(file);
    const int64_t events = countEvents(log);
    log.rewind();
    if (countEvents(log) != events) __builtin_trap();
  } catch (const InputError&) {
  }
  return 0;
}
