#include "processes/imu_integration/node.hpp"
#include "processes/run_process.hpp"

int main(int argc, char** argv) {
  return redbee::runProcess<redbee::ImuIntegrationNode>(argc, argv, redbee::kImuIntegration);
}
