// redbee doctor: checks whether the stack can run on this machine, and prints a fix for each failed check.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "processes/redbee/vehicle/finding.hpp"

namespace redbee {

struct DoctorOptions {
  std::string url;
  std::string camera_channel = "CAMERA";
  std::string imu_channel = "IMU";
  double listen_s = 2.0;
};

/// For the check of what the running stack says, before a flight.
struct LiveDoctorOptions {
  std::string url;
  std::filesystem::path configuration;
  std::filesystem::path recordings = "out/recordings";  ///< whose disk is looked at
  double listen_s = 10.0;
};

Finding findReceiveBuffer(const std::string& url);
/// Sends a message to itself on `url`.
Finding findMulticast(const std::string& url);
Finding findSpy();
std::vector<Finding> findSensors(const DoctorOptions& options);

/// Prints all findings. As root it first enters the network of a stack that is up. Returns the number of
/// failed checks.
int runDoctor(const DoctorOptions& options);
/// The same for what is heard of a stack that is up. What the vehicle's motion does not show is printed as
/// not checked and does not fail. Throws UserError where nothing is heard.
int runLiveDoctor(const LiveDoctorOptions& options);

}  // namespace redbee
