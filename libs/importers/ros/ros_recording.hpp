// A recording of ROS messages, whatever its container.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "redbee/importers/ros/ros_reader.hpp"

namespace redbee {

struct RosTopic {
  std::string name;
  std::string type;  ///< see rosKindOf()
  RosEncoding encoding = RosEncoding::kRos1;
  int64_t messages = 0;
};

struct RosMessage {
  const RosTopic* topic = nullptr;
  int64_t logged_ns = 0;  ///< when the recorder got it
  ByteView bytes;         ///< valid during the call
};

class RosRecording {
 public:
  virtual ~RosRecording() = default;

  /// One entry a name, those that can be read.
  virtual const std::vector<RosTopic>& topics() const = 0;
  /// Calls back for every message of the topics with these names, in the order of the recording, until it
  /// returns false. Can be called again. Throws InputError.
  virtual void read(const std::set<std::string>& topics,
                    const std::function<bool(const RosMessage&)>& on_message) = 0;
  /// One line each, of what has been read so far.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace redbee
