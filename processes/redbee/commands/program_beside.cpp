#include "processes/redbee/commands/program_beside.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

namespace redbee {
namespace {

void replaceBy(const std::filesystem::path& program, std::vector<std::string> words) {
  words.insert(words.begin(), program.string());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  std::fprintf(stderr, "%s: cannot be started: %s (build it with scripts/build release %s)\n",
               program.c_str(), std::strerror(errno), program.filename().c_str());
  throw CLI::RuntimeError(2);
}

Command::Setup startingBeside(const std::string& program, bool names_subcommand) {
  return [program, names_subcommand](CLI::App& command) {
    command.set_help_flag();
    command.prefix_command();
    command.callback([program, names_subcommand, &command] {
      const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
      std::vector<std::string> words = command.remaining();
      if (names_subcommand) words.insert(words.begin(), command.get_name());
      replaceBy(folder / program, std::move(words));
    });
  };
}

}  // namespace

Command::Setup programBeside(const std::string& program) { return startingBeside(program, true); }

Command::Setup processBeside(const std::string& program) { return startingBeside(program, false); }

}  // namespace redbee
