// The exit codes of all programs.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace redbee {

/// Runs `work`, which may parse the command line with `app`. 0 where it returns; otherwise one line on stderr
/// and 2 on bad use or bad input, the code of a CLI::RuntimeError (without a line), or 1 on any other
/// failure.
int exitCodeOf(const CLI::App& app, const std::function<void()>& work);

}  // namespace redbee
