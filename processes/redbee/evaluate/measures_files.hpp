// The measures of a run on disk, beside its maps.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "processes/redbee/evaluate/evaluate.hpp"

namespace redbee {

/// measures.json (null: the truth does not tell), pr.csv and pr.svg (where something moves), frames.csv.
void writeMeasures(const std::filesystem::path& results, const ClipMeasures& clip);

/// A JSON file; throws InputError where it is missing or damaged.
nlohmann::json readJson(const std::filesystem::path& file);

struct RecallPrecision {
  std::vector<double> recall;
  std::vector<double> precision;
};
/// pr.csv.
RecallPrecision readCurve(const std::filesystem::path& file);

}  // namespace redbee
