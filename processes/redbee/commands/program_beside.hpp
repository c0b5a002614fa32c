// A subcommand that is a program of its own in the folder of this one.
#pragma once

#include <string>

#include "processes/redbee/commands/command.hpp"

namespace redbee {

/// Replaces the process by `program`, with the same arguments. Where it has not been built: one line, and
/// exit code 2.
Command::Setup programBeside(const std::string& program);
/// The same for a process of the stack, which knows no subcommand.
Command::Setup processBeside(const std::string& program);

}  // namespace redbee
