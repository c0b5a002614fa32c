// What the inputs of a run hold, to say why it has no result.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "redbee/configuration/configuration.hpp"
#include "redbee/files/log.hpp"

namespace redbee {

class InputSurvey {
 public:
  explicit InputSurvey(const Configuration& configuration) : configuration_(configuration) {}

  /// For each input event of the log.
  void add(const LogEvent& event);

  int64_t images() const { return camera_.count; }
  /// Where configuration and log contradict each other about IMU and lens, one line each; empty if they do
  /// not.
  std::vector<std::string> warnings() const;
  /// Why the first image cannot be read: another type of message, a pixel format, sizes. Empty if it can.
  std::string faultOfFirstImage() const;

 private:
  struct Span {
    int64_t count = 0;
    int64_t first_utime = 0;  ///< of what the log says
    int64_t last_utime = 0;
    void add(int64_t utime);
  };

  std::string lensWarning() const;

  const Configuration& configuration_;
  Span camera_;
  Span imu_;
  int64_t lens_messages_ = 0;
  double shortest_focal_px_ = 0, longest_focal_px_ = 0;  ///< that they state; 0: none
  std::vector<uint8_t> first_image_;
};

}  // namespace redbee
