#include "processes/redbee/commands/program_beside.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <vector>

namespace redbee {
namespace {

void replaceBy(const std::filesystem::path& program, const std::string& subcommand,
               std::vector<std::string> arguments) {
  std::vector<std::string> words{program.string(), subcommand};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  std::fprintf(stderr, "%s: cannot be started: %s (build it with scripts/build release %s)\n",
               program.c_str(), std::strerror(errno), program.filename().c_str());
  throw CLI::RuntimeError(2);
}

}  // namespace

Command::Setup programBeside(const std::string& program) {
  return [program](CLI::App& command) {
    command.set_help_flag();
    command.prefix_command();
    command.callback([program, &command] {
      const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
      replaceBy(folder / program, command.get_name(), command.remaining());
    });
  };
}

}  // namespace redbee
