#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "processes/exit_code.hpp"
#include "processes/redbee/commands/command.hpp"

int main(int argc, char** argv) {
  redbee::keepFreedMemory();
  spdlog::set_default_logger(spdlog::stderr_color_mt("redbee"));
  return redbee::runTool(argc, argv);
}
