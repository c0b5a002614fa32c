// Files with the measures of a run, beside its maps.
#pragma once

#include <filesystem>
#include <vector>

#include "processes/redbee/evaluate/clip_measures.hpp"

namespace redbee {

/// measures.json (null: undefined with this truth), pr.csv and pr.svg (where something moves), frames.csv.
void writeMeasures(const std::filesystem::path& results, const ClipMeasures& clip);

struct RecallPrecision {
  std::vector<double> recall;
  std::vector<double> precision;
};
/// Reads a pr.csv.
RecallPrecision readCurve(const std::filesystem::path& file);

}  // namespace redbee
