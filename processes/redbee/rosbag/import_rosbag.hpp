// redbee import rosbag.
#pragma once

#include "redbee/importers/importer.hpp"

namespace redbee {

/// Source: a ROS 1 bag (version 2.0 or 1.2, chunks uncompressed, bz2 or lz4).
Importer rosbagImporter();

}  // namespace redbee
