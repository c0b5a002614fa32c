// The common part of importers of ROS messages.
#pragma once

#include "redbee/files/progress.hpp"
#include "redbee/importers/import.hpp"
#include "redbee/importers/ros/ros_recording.hpp"

namespace redbee {

/// Writes the chosen topics (options.topics) as a log. Times are the messages' stamps, not those of their
/// recording. Throws InputError with the file, the topic and the number of the message.
ImportSummary importRosRecording(RosRecording& recording, const ImportOptions& options, Progress& progress);

}  // namespace redbee
