#include "processes/serve/run_serve.hpp"

int main(int argc, char** argv) { return redbee::runServe(argc, argv); }
