#include "processes/exit_code.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>

#include "redbee/files/user_error.hpp"

namespace redbee {
namespace {

constexpr int kFailure = 1;
constexpr int kBadInput = 2;

int fail(int code, const std::string& line) {
  std::fprintf(stderr, "%s\n", line.c_str());
  return code;
}

}  // namespace

int exitCodeOf(const CLI::App& app, const std::function<void()>& work) {
  const std::string& program = app.get_name();
  try {
    work();
    return 0;
  } catch (const CLI::RuntimeError& error) {
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return fail(kBadInput, program + ": " + error.what() + " (see " + program + " --help)");
  } catch (const UserError& error) {
    return fail(kBadInput, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(kBadInput, error.path1().string() + ": " + error.code().message());
  } catch (const std::exception& error) {
    return fail(kFailure, program + ": " + error.what());
  }
}

}  // namespace redbee
