// redbee evaluate: a run's maps against truth masks (contract.md; method.md, "Measures").
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluation/pixel_measures.hpp"

namespace redbee {

struct EvaluateOptions {
  std::filesystem::path truth;    ///< masks <ns>.png, or a folder with labels/mask or mask in it
  std::filesystem::path results;  ///< with probability/<us>.png
};

struct ClipMeasures {
  std::string name;
  PixelMeasures pixels;
  int64_t truth_without_result = 0;  ///< labelled frames that the run has no map of; counted as empty maps
};

/// One clip. Throws InputError where a folder or a picture cannot be read, or where no labelled frame has a
/// map.
ClipMeasures measureClip(const std::filesystem::path& truth, const std::filesystem::path& results);

/// Prints the measures, writes pr.csv into the results folder. A truth folder whose subfolders are clips is
/// measured clip by clip against the results' subfolders of the same names, and the means are given.
void runEvaluate(const EvaluateOptions& options);

}  // namespace redbee
