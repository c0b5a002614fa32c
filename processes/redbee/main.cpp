#include "processes/redbee/commands/commands.hpp"

int main(int argc, char** argv) { return redbee::runTool(argc, argv); }
