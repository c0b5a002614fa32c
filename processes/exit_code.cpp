#include "processes/exit_code.hpp"

#include <malloc.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>

#include "redbee/files/printable.hpp"
#include "redbee/files/user_error.hpp"

namespace redbee {
namespace {

constexpr int kFailure = 1;
constexpr int kBadInput = 2;

/// What was printed counts as a result: one that did not arrive, as on a full disk, is no success.
void requirePrinted() {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return;
  throw std::runtime_error(std::string("standard output: cannot be written: ") +
                           (errno != 0 ? std::strerror(errno) : "an earlier write failed"));
}

int fail(int code, const std::string& line) {
  std::fprintf(stderr, "%s\n", printable(line).c_str());
  return code;
}

/// Of what a shell makes of `F.lcm.*`, the first will do.
std::string shortened(const std::string& line) {
  constexpr size_t kMost = 160;  // characters
  if (line.size() <= kMost) return line;
  const size_t blank = line.rfind(' ', kMost);
  // One long word is cut: what it begins with says more than nothing of it.
  return line.substr(0, blank == std::string::npos || blank < kMost / 2 ? kMost : blank) + " ...";
}

/// Writes one line and ends the process, without memory: destructors and handlers of its exit would need
/// some, and wait for threads that had none.
[[noreturn]] void endWithoutMemory() {
  constexpr const char* kWhat = ": out of memory\n";
  const char* name = program_invocation_short_name;
  const bool written = write(STDERR_FILENO, name, std::strlen(name)) >= 0 &&
                       write(STDERR_FILENO, kWhat, std::strlen(kWhat)) >= 0;
  static_cast<void>(written);  // there is no other place to say it
  std::_Exit(kFailure);
}

}  // namespace

void endWhereMemoryIsShort() { std::set_new_handler(endWithoutMemory); }

void keepFreedMemory() {
  constexpr int kLarge = 32 << 20;  // bytes: more than any image takes, and the most that glibc accepts
  mallopt(M_MMAP_THRESHOLD, kLarge);
  mallopt(M_TRIM_THRESHOLD, kLarge);
}

int exitCodeOf(const CLI::App& app, const std::function<void()>& work) {
  const std::string& program = app.get_name();
  try {
    work();
    requirePrinted();
    return 0;
  } catch (const std::bad_alloc&) {
    endWithoutMemory();
  } catch (const CLI::RuntimeError& error) {
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return exitCodeOf(app, [&] { app.exit(error); });  // --help, --version
    return fail(kBadInput, program + ": " + shortened(error.what()) + " (see " + program + " --help)");
  } catch (const UserError& error) {
    return fail(kBadInput, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(kBadInput, error.path1().string() + ": " + error.code().message());
  } catch (const std::exception& error) {
    return fail(kFailure, program + ": " + error.what());
  }
}

}  // namespace redbee
