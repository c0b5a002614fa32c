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

Importer rosbagImporter() {
  Importer importer;
  importer.name = kRosbagName;
  importer.description = kRosbagDescription;
  importer.source = "F.bag";
  importer.takes.units = true;
  importer.takes.keep_going = true;
  importer.takes.topics = true;
  importer.defaults.jpeg_quality = 95;
  importer.import = importRosbag;
  return importer;
}

}  // namespace redbee
