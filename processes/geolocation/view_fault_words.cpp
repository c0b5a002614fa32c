#include "processes/geolocation/view_fault_words.hpp"

namespace redbee {

std::string wordsOf(ViewFault fault, const Channels& channels) {
  switch (fault) {
    case ViewFault::kNone:
      return "";
    case ViewFault::kNoPose:
      return "no " + channels.pose;
    case ViewFault::kStalePose:
      return "no " + channels.pose + " near the frame";
    case ViewFault::kNoPosition:
      return channels.pose + " has no position, neither by satellites nor from the place of take-off";
    case ViewFault::kNoMount:
      return "no " + channels.gimbal + " near the frame: geolocation.mount is gimbal";
    case ViewFault::kNoHeight:
      return "no height above the ground: no " + channels.altimeter + ", and " + channels.pose +
             " is not above the place of take-off";
  }
  return "";
}

}  // namespace redbee
