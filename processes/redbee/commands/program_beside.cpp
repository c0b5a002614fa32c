#include "processes/redbee/commands/program_beside.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "redbee/files/user_error.hpp"

namespace redbee {
namespace {

using Words = std::vector<std::string>;

std::filesystem::path beside(const std::string& program) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / program;
}

/// As exec wants them; it points into the words.
std::vector<char*> argumentsOf(Words& words) {
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  return argv;
}

/// Options may stand before it, and take values; empty if there is none.
std::string firstFileOf(const Words& arguments) {
  for (const std::string& word : arguments) {
    std::error_code error;
    if (std::filesystem::is_regular_file(word, error)) return word;
  }
  return "";
}

void replaceBy(const std::filesystem::path& program, Words arguments) {
  arguments.insert(arguments.begin(), program.string());
  execv(program.c_str(), argumentsOf(arguments).data());
  std::fprintf(
      stderr,
      "%s: cannot be started: %s (a package of its own, see config/README.md; or scripts/build release %s)\n",
      program.c_str(), std::strerror(errno), program.filename().c_str());
  throw CLI::RuntimeError(2);
}

Command::Setup startingBeside(const std::string& program, bool names_subcommand) {
  return [program, names_subcommand](CLI::App& command) {
    command.set_help_flag();
    command.prefix_command();
    command.callback([program, names_subcommand, &command] {
      Words words = command.remaining();
      if (names_subcommand) words.insert(words.begin(), command.get_name());
      replaceBy(beside(program), std::move(words));
    });
  };
}

}  // namespace

bool isBeside(const std::string& program) {
  std::error_code error;
  return std::filesystem::exists(beside(program), error);
}

Command::Setup programBeside(const std::string& program) { return startingBeside(program, true); }

Command::Setup processBeside(const std::string& program) { return startingBeside(program, false); }

void runProgramBeside(const std::string& program, const std::string& subcommand, const Words& arguments,
                      const std::string& how) {
  Words words{beside(program).string(), subcommand};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::fflush(stdout);
  pid_t child = 0;
  if (const int error =
          posix_spawn(&child, words.front().c_str(), nullptr, nullptr, argumentsOf(words).data(), environ);
      error != 0) {
    throw UserError(words.front() + ": cannot be started: " + std::strerror(error) + " (" + how + ")");
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    const std::string input = firstFileOf(arguments);
    throw UserError((input.empty() ? "" : input + ": is damaged: ") + program + " was ended by signal " +
                    std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) + ")");
  }
  if (WEXITSTATUS(status) != 0) throw CLI::RuntimeError(WEXITSTATUS(status));
}

}  // namespace redbee
