#include "processes/geolocation/node.hpp"
#include "processes/run_process.hpp"

int main(int argc, char** argv) {
  return redbee::runProcess<redbee::GeolocationNode>(argc, argv, redbee::kGeolocation);
}
