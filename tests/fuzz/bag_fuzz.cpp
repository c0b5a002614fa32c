// Any bytes as a ROS 1 bag: imported, or refused. ROS's own library reads it, in this process; on a vehicle
// and for `redbee import` it has one of its own.
#include "processes/redbee/rosbag/bag_recording.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/importers/ros/import_ros.hpp"
#include "tests/fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  static const fuzz::Folder folder;
  ImportOptions options;
  options.source = folder.write("f.bag", std::string(reinterpret_cast<const char*>(data), size));
  options.log = folder / "flight.lcm";
  options.keep_going = true;
  Progress progress("", "", true);
  try {
    importRosRecording(*openBag(options.source), options, progress);
  } catch (const InputError&) {
  }
  return 0;
}
