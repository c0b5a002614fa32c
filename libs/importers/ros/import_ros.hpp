// The common part of importers of ROS messages.
#pragma once

#include <string>

#include "redbee/files/progress.hpp"
#include "redbee/importers/importer.hpp"
#include "redbee/importers/ros/ros_recording.hpp"

namespace redbee {

/// Writes the chosen topics (options.topics) as a log. Times are the messages' stamps, not those of their
/// recording. Throws InputError with the file, the topic and the number of the message.
ImportSummary importRosRecording(RosRecording& recording, const ImportOptions& options, Progress& progress);

/// An importer of ROS messages, whatever its container: what it takes, and its defaults.
Importer rosImporter(const std::string& name, const std::string& description, const std::string& source,
                     ImportSummary (*import)(const ImportOptions&, Progress&));

}  // namespace redbee
