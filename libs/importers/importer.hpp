// The table of importers. A new one is a file of its own and one line in importer.cpp.
#pragma once

#include <string>
#include <vector>

#include "redbee/files/progress.hpp"
#include "redbee/importers/import.hpp"

namespace redbee {

/// The options that an importer supports beside source and log; the tool offers no others.
struct ImporterTakes {
  bool width = false;
  bool fps = false;
  bool imu = false;
  bool units = false;     ///< of gyro and accelerometer
  bool chapters = false;  ///< several files of one recording
  bool keep_going = false;
  bool topics = false;  ///< of ROS messages
};

struct Importer {
  std::string name;         ///< `redbee import NAME`
  std::string description;  ///< one line of help
  std::string source;       ///< what the source is, for the help
  ImporterTakes takes;
  ImportOptions defaults;
  /// Throws InputError, and then there is no log.
  ImportSummary (*import)(const ImportOptions& options, Progress& progress) = nullptr;
};

const std::vector<Importer>& importers();

/// Imports, then completes the camera: by the camchain where there is one, its intrinsics scaled to the
/// images' size; by an assumed focal length where the recording states none (assumeIntrinsics()). Throws
/// InputError, and then there is no log; a log that would replace what is read is refused.
ImportSummary importRecording(const Importer& importer, const ImportOptions& options, Progress& progress);

}  // namespace redbee
