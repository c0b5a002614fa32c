// redbee evaluate: compares the maps of a run with ground-truth masks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "processes/redbee/evaluate/clip_measures.hpp"

namespace redbee {

struct EvaluateOptions {
  /// See ClipTruth; "none": nothing moves. Of several clips: their folders side by side.
  std::filesystem::path truth;
  std::filesystem::path results;  ///< see RunFolder
  std::filesystem::path log;      ///< the flight; empty: no images, and frame numbers count the run's maps
  std::string camera_channel = "CAMERA";  ///< of the log
  int64_t frames = 0;                     ///< only the first frames of the recording; 0: all
};

/// One clip. Throws InputError if a folder or an image cannot be read, or where no labelled frame has a map.
ClipMeasures measureClip(const EvaluateOptions& options);

/// Prints the measures; writes measures.json, pr.csv, pr.svg, frames.csv and, with a log, images of the best
/// and the worst frames (images/*.jpg) to the results folder. If the subfolders of the truth folder are
/// clips, each is measured against the results' subfolder of the same name, and the means are printed too.
void runEvaluate(const EvaluateOptions& options);

}  // namespace redbee
