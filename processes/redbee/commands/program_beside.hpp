// A subcommand that is a program of its own in the folder of this one.
#pragma once

#include <string>
#include <vector>

#include "processes/redbee/commands/command.hpp"

namespace redbee {

/// Whether it was built, or its package installed.
bool isBeside(const std::string& program);

/// Replaces the process by `program`, with the same arguments. Where it has not been built: one line, and
/// exit code 2.
Command::Setup programBeside(const std::string& program);
/// The same for a process of the stack, which knows no subcommand.
Command::Setup processBeside(const std::string& program);

/// Runs `program SUBCOMMAND ARGUMENT...` and waits for it. Throws UserError where it cannot be started, with
/// `how` to get it; and where a signal ended it; CLI::RuntimeError with its exit code where that is not 0.
void runProgramBeside(const std::string& program, const std::string& subcommand,
                      const std::vector<std::string>& arguments, const std::string& how);

}  // namespace redbee
