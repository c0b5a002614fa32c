// redbee import mcap: recordings of rosbag2 and Foxglove.
#pragma once

#include <memory>

#include "redbee/importers/importer.hpp"
#include "redbee/importers/ros/ros_recording.hpp"

namespace redbee {

/// Source: an MCAP file, or a folder with the parts of one recording. Messages of ROS 2 (CDR) and ROS 1 are
/// read, see rosKindOf().
Importer mcapImporter();

/// Its topics and messages. `keep_going`: of a file that is damaged, or cut short, what is whole is read,
/// with a warning. Throws InputError with the fix.
std::unique_ptr<RosRecording> openMcap(const std::filesystem::path& source, bool keep_going);

}  // namespace redbee
