// The exit codes of all programs.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace redbee {

/// From now on a failed allocation ends the process, with one line on stderr and exit code 1, rather than
/// throw: code of C libraries and of handlers cannot go on from there, and would abort.
void endWhereMemoryIsShort();

/// From now on freed memory stays with the process. Images of each frame are as large as those of the one
/// before; by default the C library returns such memory at once, and every frame's pages are mapped and
/// cleared again.
void keepFreedMemory();

/// Runs `work`, which may parse the command line with `app`. Returns 0 on success; otherwise prints one line
/// on stderr and returns 2 for bad use or bad input, 1 for any other failure, as where standard output cannot
/// be written. For a CLI::RuntimeError it returns its code and prints nothing.
int exitCodeOf(const CLI::App& app, const std::function<void()>& work);

}  // namespace redbee
