#include "processes/redbee/rosbag/import_rosbag.hpp"

#include "processes/redbee/rosbag/bag_recording.hpp"
#include "processes/redbee/rosbag/rosbag_program.hpp"
#include "redbee/importers/ros/import_ros.hpp"

namespace redbee {
namespace {

ImportSummary importRosbag(const ImportOptions& options, Progress& progress) {
  return importRosRecording(*openBag(options.source), options, progress);
}

}  // namespace

Importer rosbagImporter() { return rosImporter(kRosbagName, kRosbagDescription, "F.bag", importRosbag); }

}  // namespace redbee
