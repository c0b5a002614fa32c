// redbee evaluate: a run's maps against truth masks (contract.md; method.md, "Measures").
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "redbee/evaluation/object_measures.hpp"
#include "redbee/evaluation/pixel_measures.hpp"

namespace redbee {

struct EvaluateOptions {
  /// See ClipTruth; "none": nothing moves. Of several clips: their folders side by side.
  std::filesystem::path truth;
  std::filesystem::path results;  ///< with probability/<us>.png and mask/<us>.png
  std::filesystem::path log;      ///< the flight; empty: no images, and frame numbers are those of the maps
  std::string camera_channel = "CAMERA";  ///< of the log
  int64_t frames = 0;                     ///< only the first so many of the recording; 0: all
};

/// How one labelled frame came out, by the mask that the method decided on.
struct FrameOutcome {
  int64_t utime = 0;         ///< us
  int64_t hits = 0;          ///< px that move and are in the mask
  int64_t false_alarms = 0;  ///< px that do not and are
  int64_t misses = 0;        ///< px that move and are not
  ObjectCounts objects;
};

struct ClipMeasures {
  std::string name;
  bool has_movers = false;  ///< false: the recall, the error and F1 say nothing
  PixelMeasures pixels;     ///< of P_FG, at every threshold
  PixelMeasures decided;    ///< of the mask, which is the method's own operating point
  ObjectMeasures objects;   ///< of the mask
  std::vector<FrameOutcome> frames;
  int64_t frames_limit = 0;          ///< EvaluateOptions::frames
  int64_t truth_without_result = 0;  ///< labelled frames that the run has no map of; counted as empty maps
};

/// One clip. Throws InputError where a folder or a image cannot be read, or where no labelled frame has a
/// map.
ClipMeasures measureClip(const EvaluateOptions& options);

/// Prints the measures; leaves measures.json, pr.csv, pr.svg, frames.csv and, with a log, images of the
/// best and the worst frames (images/*.jpg) in the results folder. A truth folder whose subfolders are
/// clips is measured clip by clip against the results' subfolders of the same names, and the means are given.
void runEvaluate(const EvaluateOptions& options);

}  // namespace redbee
