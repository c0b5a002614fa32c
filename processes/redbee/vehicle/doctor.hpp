// redbee doctor: checks whether the stack can run on this machine, and prints a fix for each failed check.
#pragma once

#include <string>
#include <vector>

namespace redbee {

struct Finding {
  bool good = false;
  std::string what;  ///< one line
  std::string fix;   ///< a command or a step; empty if nothing is wrong
};

struct DoctorOptions {
  std::string url;
  std::string camera_channel = "CAMERA";
  std::string imu_channel = "IMU";
  double listen_s = 2.0;
};

Finding findReceiveBuffer(const std::string& url);
/// Sends a message to itself on `url`.
Finding findMulticast(const std::string& url);
Finding findSpy();
std::vector<Finding> findSensors(const DoctorOptions& options);

/// Prints all findings. Returns the number of failed checks.
int runDoctor(const DoctorOptions& options);

}  // namespace redbee
