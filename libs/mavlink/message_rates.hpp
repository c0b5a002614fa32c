// Asks the autopilot for messages until they come at the rate that is wanted (SET_MESSAGE_INTERVAL).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "redbee/mavlink/parameters.hpp"

namespace redbee::mavlink {

/// The messages of an IMU, the best first: microseconds and the sensor's resolution; microseconds and
/// milli-units; milliseconds and another sensor.
inline constexpr uint32_t kImuMessages[] = {105, 27, 116};  // HIGHRES_IMU, RAW_IMU, SCALED_IMU2

struct RateRequest {
  uint32_t id = 0;
  double rate_hz = 0;
};

class MessageRates {
 public:
  explicit MessageRates(const AutopilotParameters& parameters);

  void noteMessage(uint32_t id) { ++heard_[id]; }
  /// What to ask for now; to be called often. Every second, later every ten, messages are asked for that came
  /// at less than half of their rate since. Of an IMU's messages the next is asked for when the one before
  /// stays out.
  std::vector<RateRequest> due(int64_t host_ns);
  /// The autopilot is another one, or was started again.
  void restart();
  /// Whether a message of an IMU is the best that comes.
  bool isBestImu(uint32_t id) const;

 private:
  struct Wanted {
    double rate_hz = 0;
    int asked = 0;
    bool comes = false;  ///< in the last period
  };
  bool isWanted(uint32_t id) const;

  std::map<uint32_t, Wanted> wanted_;
  std::map<uint32_t, int> heard_;     ///< since the last period began
  std::optional<int64_t> period_ns_;  ///< when it began
};

}  // namespace redbee::mavlink
